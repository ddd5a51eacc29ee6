// What balls with a size can cancel: by hand where a formula exists, and never less than randomly placed balls.
#include "equipoise/machine/balance/cancelling.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <numeric>
#include <random>
#include <vector>

#include "equipoise/core/base/angles.hpp"

namespace cancelling_test {

using equipoise::pi;
using equipoise::two_pi;
using equipoise::model::Cancelling;
using equipoise::model::cancelling;
using equipoise::model::Parameters;

constexpr double rounding = 1e-14;

Parameters balls(std::initializer_list<double> masses) {
  Parameters p;
  p.balls = 0;
  for (const double m : masses) p.mass[p.balls++] = m;
  return p;
}

TEST(Cancelling, BallsWithoutASizeMakeWhatPolygonsDo) {
  const Cancelling unequal = cancelling(balls({0.3, 0.1, 0.05}));
  EXPECT_NEAR(unequal.least(), 0.15, rounding);
  EXPECT_NEAR(unequal.most(), 0.45, rounding);
  const Cancelling one = cancelling(balls({0.3}));
  EXPECT_NEAR(one.least(), 0.3, rounding);
  EXPECT_TRUE(one.cancels(0.3));
  EXPECT_FALSE(one.cancels(0.300001));
}

TEST(Cancelling, EqualBallsSideBySideMakeTheFormula) {
  Parameters p = balls({0.1, 0.1, 0.1, 0.1, 0.1, 0.1});
  p.contact_angle = 0.505360510284157;
  const Cancelling six = cancelling(p);
  ASSERT_EQ(six.ranges.size(), 1u);
  EXPECT_EQ(six.least(), 0.0);
  EXPECT_NEAR(six.most(), 0.1 * std::sin(3.0 * p.contact_angle) / std::sin(0.5 * p.contact_angle), rounding);
  EXPECT_TRUE(six.cancels(0.39));
  EXPECT_FALSE(six.cancels(0.41));
  EXPECT_TRUE(six.cancels(0.0));
}

TEST(Cancelling, OneHeavyBallLeavesARestThatSizeMakesLarger) {
  // Opposite it the two others make 2 cos(0.15) side by side.
  const Cancelling three = cancelling(balls({1.99, 1.0, 1.0}), {0.3, 0.3, 0.3});
  EXPECT_NEAR(three.least(), 1.99 - 2.0 * std::cos(0.15), rounding);
  // The heavy one in the middle of the row.
  EXPECT_NEAR(three.most(), 1.99 + 2.0 * std::cos(0.3), rounding);
  EXPECT_FALSE(three.cancels(0.012));
  EXPECT_TRUE(three.cancels(0.013));
}

TEST(Cancelling, AFullRaceLeavesOneSumForEveryOrder) {
  // Four balls of a quarter each: the three orders give |m1 - m3 + i (m2 - m4)|, by which balls are opposite.
  const Cancelling full = cancelling(balls({1.0, 2.0, 4.0, 8.0}), std::vector<double>(4, 0.5 * pi));
  const double opposite[3] = {std::hypot(1.0, 4.0), std::hypot(3.0, 6.0), std::hypot(7.0, 2.0)};
  ASSERT_EQ(full.ranges.size(), 3u);
  // Rounding of widths leaves gaps of the same size.
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(full.ranges[k][1], opposite[k], 1e-12);
  for (const double sum : opposite) EXPECT_TRUE(full.cancels(sum));
  EXPECT_FALSE(full.cancels(5.0));
  EXPECT_FALSE(cancelling(balls({1.0, 1.0}), {3.2, 3.2}).fit());
  EXPECT_FALSE(cancelling(balls({1.0, 1.0}), {3.2, 3.2}).cancels(0.0));
}

TEST(Cancelling, BallsAtRandomStayWithinAndComeNear) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int study = 0; study < 60; ++study) {
    Parameters p;
    p.balls = 2 + study % 3;
    std::vector<double> width;
    for (int i = 0; i < p.balls; ++i) {
      p.mass[i] = 0.2 + uniform(random);
      width.push_back(0.05 + uniform(random));
    }
    const double filled = two_pi * (0.1 + 0.85 * uniform(random));
    const double all = std::accumulate(width.begin(), width.end(), 0.0);
    for (double& w : width) w *= filled / all;
    const Cancelling range = cancelling(p, width);
    std::vector<int> order(static_cast<std::size_t>(p.balls));
    std::iota(order.begin(), order.end(), 0);
    double lowest = 1e300, highest = 0.0;
    for (int draw = 0; draw < 4000; ++draw) {
      std::shuffle(order.begin(), order.end(), random);
      std::vector<double> gap;
      for (int i = 0; i < p.balls; ++i) gap.push_back(uniform(random) < 0.4 ? 1e-12 : -std::log1p(-uniform(random)));
      const double gaps = std::accumulate(gap.begin(), gap.end(), 0.0);
      std::complex<double> sum;
      double angle = 0.0;
      for (int k = 0; k < p.balls; ++k) {
        const int here = order[k], next = order[(k + 1) % p.balls];
        sum += std::polar(p.mass[here], angle);
        angle += 0.5 * (width[here] + width[next]) + (two_pi - filled) * gap[k] / gaps;
      }
      EXPECT_TRUE(range.cancels(std::abs(sum))) << "study " << study << ": " << std::abs(sum);
      lowest = std::min(lowest, std::abs(sum));
      highest = std::max(highest, std::abs(sum));
    }
    // 4000 draws of up to four balls, many of them touching, come this near to both ends.
    EXPECT_LT(lowest - range.least(), 0.1) << study;
    EXPECT_LT(range.most() - highest, 0.1) << study;
  }
}

// Eight heavy balls and eight light ones: all orders are tried, and the row with the heavy ones in the middle is best.
TEST(Cancelling, SixteenBallsOfTwoKindsMakeARowWithTheHeavyOnesInTheMiddle) {
  Parameters p;
  p.balls = 16;
  for (int i = 0; i < 16; ++i) p.mass[i] = i % 2 ? 2.0 : 1.0;
  p.contact_angle = 0.3;
  const Cancelling range = cancelling(p);
  double most = 0.0;
  for (int k = 0; k < 16; ++k) most += (k >= 4 && k < 12 ? 2.0 : 1.0) * std::cos(0.3 * (k - 7.5));
  EXPECT_TRUE(range.all_tried);
  EXPECT_NEAR(range.most(), most, 1e-12);
  EXPECT_EQ(range.least(), 0.0);
}

TEST(Cancelling, SixteenUnlikeBallsAreToldOfWithoutAllOrders) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(1.0, 2.0);
  Parameters p;
  p.balls = 16;
  for (int i = 0; i < 16; ++i) p.mass[i] = uniform(random);
  p.contact_angle = 0.25;
  const Cancelling range = cancelling(p);
  EXPECT_TRUE(range.all_tried);  // the first order reaches all there is
  ASSERT_EQ(range.ranges.size(), 1u);
  EXPECT_EQ(range.least(), 0.0);
  std::vector<int> order(16);
  std::iota(order.begin(), order.end(), 0);
  double highest = 0.0;
  for (int draw = 0; draw < 20000; ++draw) {
    std::shuffle(order.begin(), order.end(), random);
    std::complex<double> sum;
    for (int k = 0; k < 16; ++k) sum += std::polar(p.mass[order[k]], 0.25 * k);
    highest = std::max(highest, std::abs(sum));
  }
  EXPECT_LE(highest, range.most());
  EXPECT_GT(highest, 0.95 * range.most());
  // A full race leaves little for each order, and not all orders are tried.
  p.contact_angle = two_pi / 16.0;
  const Cancelling full = cancelling(p);
  EXPECT_FALSE(full.all_tried);
  EXPECT_TRUE(full.cancels(full.most()));
  EXPECT_STREQ(full.why_not(2.0 * full.most()),
               "of many orders of these balls in the race, none that was tried cancels just the unbalance");
}

}  // namespace cancelling_test
