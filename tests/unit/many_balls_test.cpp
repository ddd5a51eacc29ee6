// Up to sixteen balls: copies of motions by exchange of alike balls against binomials and against all orders of a few;
// the pairings that this rests on; motions recognised whatever their balls are called.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <set>
#include <vector>

#include "../support/parameters.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/orders.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {
namespace many_balls_test {

using Eigen::MatrixXd;
using Eigen::VectorXd;

std::int64_t choose(int n, int k) {
  std::int64_t ways = 1;
  for (int j = 1; j <= k; ++j) ways = ways * (n - j + 1) / j;
  return ways;
}

TEST(Pairs, AreTheCheapestAndAllAreCounted) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int round = 0; round < 300; ++round) {
    const int n = 1 + round % 6;
    MatrixXd cost(n, n);
    Eigen::MatrixXi allowed(n, n);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < n; ++k) {
        allowed(i, k) = uniform(random) < 0.7;
        cost(i, k) = allowed(i, k) ? uniform(random) : no_pair;
      }
    std::vector<int> order(static_cast<std::size_t>(n));
    std::iota(order.begin(), order.end(), 0);
    double least = no_pair;
    std::int64_t ways = 0;
    do {
      double sum = 0.0;
      for (int i = 0; i < n; ++i) sum += cost(i, order[i]);
      least = std::min(least, sum);
      ways += sum < no_pair;
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_EQ(count_pairings(allowed), ways);
    const std::vector<int> pairs = cheapest_pairs(cost);
    ASSERT_EQ(pairs.empty(), ways == 0);
    if (pairs.empty()) continue;
    EXPECT_EQ(std::set<int>(pairs.begin(), pairs.end()).size(), pairs.size());
    double sum = 0.0;
    for (int i = 0; i < n; ++i) sum += cost(i, pairs[i]);
    EXPECT_NEAR(sum, least, 1e-14);
  }
  EXPECT_EQ(count_pairings(Eigen::MatrixXi::Ones(16, 16)), 20'922'789'888'000);  // 16!
}

TEST(Orders, AreTheFirstOfThoseThatDifferInLikeThingsOnly) {
  const std::vector<int> kind{0, 1, 0, 2, 1};
  std::vector<std::vector<int>> visited, expected;
  any_order(
      5, [](int, int) { return true; }, [&](int i, int k) { return kind[i] == kind[k]; },
      [&](const std::vector<int>& order) {
        visited.push_back(order);
        return false;
      });
  std::set<std::vector<int>> seen;
  std::vector<int> order{0, 1, 2, 3, 4};
  do {
    std::vector<int> kinds;
    for (const int k : order) kinds.push_back(kind[k]);
    if (seen.insert(kinds).second) expected.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  EXPECT_EQ(visited, expected);
  EXPECT_EQ(visited.size(), 30u);  // 5!/(2! 2! 1!)
}

// Rotors of many balls that sit in two places: of ball 0 of a rotor with two balls, `first` of them, and of ball 1.
VectorXd spread(const VectorXd& two, int first, int balls) {
  VectorXd z(model::dimension(balls));
  z.head(4) = two.head(4);
  for (int i = 0; i < balls; ++i) {
    z[model::index::phi(i)] = two[i < first ? 4 : 5];
    z[model::index::q(i, balls)] = two[i < first ? 6 : 7];
  }
  return z;
}

model::Parameters halves(int balls, double drag) { return base_rotor(balls, drag, 0.1 / balls); }

// The motion of two balls, each of them split into half of `balls`.
Motion split(const Motion& two, int balls, double drag) {
  const model::System system(halves(balls, drag), two.speed);
  std::vector<VectorXd> nodes;
  for (const VectorXd& node : two.orbit.nodes) nodes.push_back(spread(node, balls / 2, balls));
  const auto orbit = refine_orbit(system, nodes, two.period);
  EXPECT_TRUE(orbit);
  return describe_orbit(system, *orbit);
}

// Of two balls, from the first of some starts that ends in a motion of this name.
Motion of_two(double drag, double speed, const char* name) {
  const model::Parameters p = base_rotor(2, drag);
  for (int k = 0; k < 40; ++k) {
    const std::vector<double> phi{0.7 * k, 1.9 * k + 1.0};
    const auto motion = motion_from({p, speed}, model::centred_state(p, phi.data()));
    if (motion && motion->kind == MotionKind::periodic && motion_name(p, *motion).name == name) return *motion;
  }
  ADD_FAILURE() << "no start comes to " << name;
  return {};
}

// By all orders, as the definition says.
std::int64_t copies_by_all_orders(const model::System& system, const Motion& motion) {
  const int n = system.balls();
  const OrbitCurve orbit(system, motion.orbit);
  BallOrder order{};
  std::iota(order.begin(), order.begin() + n, 0);
  std::int64_t all = 0, unchanged = 0;
  do {
    ++all;
    const VectorXd there = motion.state(exchanged_components(n, order));
    unchanged += orbit.distance(there) < 1e-6;
  } while (std::next_permutation(order.begin(), order.begin() + n));
  return all / unchanged;
}

TEST(Copies, OfAMotionInTwoGroupsAreABinomial) {
  constexpr double drag = 0.05, speed = 3.4;
  const Motion captured = of_two(drag, speed, "one captured");
  ASSERT_EQ(captured.copies, 2);
  for (const int n : {4, 6, 8, 12, 16}) {
    const Motion motion = split(captured, n, drag);
    EXPECT_EQ(motion.copies, choose(n, n / 2)) << n;
    if (n <= 6) {
      EXPECT_EQ(motion.copies, copies_by_all_orders({halves(n, drag), speed}, motion)) << n;
    }
    if (n > 4) continue;
    EXPECT_EQ(exchange_images({halves(n, drag), speed}, motion).size(), 6u);
  }
}

// Half a period later each group does what the other did.
TEST(Copies, OfAPairThatExchangesItselfAreHalfOfThat) {
  constexpr double drag = 0.01, speed = 4.0;
  const Motion pair = of_two(drag, speed, "pair drift");
  ASSERT_EQ(pair.copies, 1);
  for (const int n : {4, 6, 12, 16}) {
    const Motion motion = split(pair, n, drag);
    EXPECT_EQ(motion.copies, choose(n, n / 2) / 2) << n;
    if (n <= 6) {
      EXPECT_EQ(motion.copies, copies_by_all_orders({halves(n, drag), speed}, motion)) << n;
    }
    if (n > 4) continue;
    EXPECT_EQ(exchange_images({halves(n, drag), speed}, motion).size(), 3u);
  }
}

TEST(Copies, OfBallsInOnePlaceIsOne) {
  for (const int n : {9, 12, 16}) {
    const model::Parameters p = halves(n, 0.05);
    const std::vector<double> phi(static_cast<std::size_t>(n), 2.0);
    const auto motion = motion_from({p, 2.4}, model::centred_state(p, phi.data()));
    ASSERT_TRUE(motion);
    EXPECT_EQ(motion->kind, MotionKind::periodic);
    EXPECT_EQ(motion->copies, 1) << n;
    EXPECT_EQ(exchange_images({p, 2.4}, *motion).size(), 1u);
  }
}

// Balls at rest on the heavy side and opposite to it: any of them may be the ones opposite.
TEST(Copies, OfRestInTwoPlacesAreABinomialOfEachKind) {
  for (const int n : {9, 12, 16})
    for (const int opposite : {1, 4}) {
      model::Parameters p = halves(n, 0.05);
      p.eccentricity = 0.2;
      const model::System system(p, 0.6);
      VectorXd z = VectorXd::Zero(model::dimension(n));
      for (int i = 0; i < opposite; ++i) z[model::index::phi(i)] = pi;
      const auto rest = refine_equilibrium(system, z);
      ASSERT_TRUE(rest);
      EXPECT_EQ(describe_equilibrium(system, *rest).copies, choose(n, opposite)) << n;
      // One of those opposite and one of the others are of a kind of their own.
      p.mass[0] *= 1.25;
      p.mass[n - 1] *= 1.25;
      const model::System unlike(p, 0.6);
      const auto other = refine_equilibrium(unlike, z);
      ASSERT_TRUE(other);
      EXPECT_EQ(describe_equilibrium(unlike, *other).copies, 2 * choose(n - 2, opposite - 1)) << n;
    }
}

TEST(SameMotion, WhateverTheBallsAreCalled) {
  constexpr double drag = 0.05, speed = 3.4;
  constexpr int n = 16;
  const model::Parameters p = halves(n, drag);
  const model::System system(p, speed);
  const Motion motion = split(of_two(drag, speed, "one captured"), n, drag);
  std::mt19937 random(5);
  BallOrder order{};
  std::iota(order.begin(), order.begin() + n, 0);
  for (std::size_t round = 0; round < 3; ++round) {
    std::shuffle(order.begin(), order.begin() + n, random);
    std::vector<VectorXd> nodes;
    const std::size_t count = motion.orbit.nodes.size(), first = round * count / 3;  // beginning elsewhere on it
    for (std::size_t k = first; k < first + count; ++k) {
      VectorXd node = motion.orbit.nodes[k % count];
      for (int i = 0; i < n && k >= count; ++i) node[model::index::phi(i)] += two_pi * motion.winding[i];
      nodes.push_back(node(exchanged_components(n, order)));
    }
    const auto orbit = refine_orbit(system, nodes, motion.period);
    ASSERT_TRUE(orbit);
    EXPECT_TRUE(same_motion(p, motion, describe_orbit(system, *orbit)));
  }
  const Motion other = split(of_two(drag, 3.5, "one captured"), n, drag);
  EXPECT_FALSE(same_motion(p, motion, other));
}

}  // namespace many_balls_test
}  // namespace equipoise
