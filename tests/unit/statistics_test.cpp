// Starts and shares: addressing, uniformity, intervals.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {
namespace statistics_test {

TEST(Starts, AreAddressedBySeedAndIndexAlone) {
  double a[8], b[8];
  start_angles(7, 123456789, 8, a);
  start_angles(7, 123456789, 8, b);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(a[i], b[i]);
  start_angles(7, 123456789, 2, b);  // fewer balls get the same first angles
  EXPECT_EQ(a[0], b[0]);
  EXPECT_EQ(a[1], b[1]);
  start_angles(8, 123456789, 2, b);
  EXPECT_NE(a[0], b[0]);
  start_angles(7, 123456790, 2, b);
  EXPECT_NE(a[0], b[0]);
}

TEST(Starts, AreUniformAndUncorrelated) {
  constexpr int count = 200000;
  double mean[8] = {}, product = 0.0;
  for (int k = 0; k < count; ++k) {
    double phi[8];
    start_angles(1, k, 8, phi);
    for (int i = 0; i < 8; ++i) {
      ASSERT_GE(phi[i], 0.0);
      ASSERT_LT(phi[i], two_pi);
      mean[i] += phi[i] / count;
    }
    product += (phi[0] - pi) * (phi[1] - pi) / count;
  }
  // Standard errors: 1.81/sqrt(count) of a mean, 3.29/sqrt(count) of the covariance; five of them.
  for (double m : mean) EXPECT_NEAR(m, pi, 5 * 1.81 / std::sqrt(count));
  EXPECT_NEAR(product, 0.0, 5 * 3.29 / std::sqrt(count));
}

TEST(Share, WilsonIntervalHasItsPublishedValues) {
  // R. G. Newcombe, Stat. Med. 17 (1998) 857, table I, method 3 (score without continuity correction).
  const Share a = wilson_share(81, 263);
  EXPECT_NEAR(a.low, 0.2553, 5e-5);
  EXPECT_NEAR(a.high, 0.3662, 5e-5);
  const Share b = wilson_share(15, 148);
  EXPECT_NEAR(b.low, 0.0624, 5e-5);
  EXPECT_NEAR(b.high, 0.1605, 5e-5);
  const Share zero = wilson_share(0, 20);
  EXPECT_EQ(zero.low, 0.0);
  EXPECT_NEAR(zero.high, 0.1611, 5e-5);
  const Share all = wilson_share(29, 29);
  EXPECT_EQ(all.high, 1.0);
  EXPECT_NEAR(all.low, 0.8830, 5e-5);
  EXPECT_EQ(wilson_share(0, 0).high, 1.0);
}

TEST(Share, IntervalsCoverTheTruthAsOftenAsTheySay) {
  std::mt19937_64 random(1);
  for (double truth : {0.5, 0.1, 0.01}) {
    constexpr int trials = 4000;
    std::binomial_distribution<int> draw(1000, truth);
    int covered = 0;
    for (int k = 0; k < trials; ++k) {
      const Share s = wilson_share(draw(random), 1000);
      covered += s.low <= truth && truth <= s.high;
    }
    // 95 % nominal; the discrete count changes coverage by a point and a half, 4000 trials by five standard errors of
    // 0.34 %.
    EXPECT_NEAR(covered / double(trials), 0.95, 0.032) << truth;
  }
}

}  // namespace statistics_test
}  // namespace equipoise
