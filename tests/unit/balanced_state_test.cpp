// Existence and angles of balanced states: the polygon inequality and its edge cases (docs/explanation/equations.md,
// "Existence").
#include "equipoise/machine/balance/balanced_state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <initializer_list>

#include "equipoise/core/base/angles.hpp"

namespace balanced_state_test {

using equipoise::pi;
using equipoise::model::balanced_states;
using equipoise::model::Parameters;
using Kind = equipoise::model::BalancedStates::Kind;

Parameters rotor(double lambda, std::initializer_list<double> masses) {
  Parameters p;
  p.eccentricity = lambda;
  p.balls = 0;
  for (double m : masses) p.mass[p.balls++] = m;
  p.drag.fill(0.05);
  return p;
}

double unbalance(const Parameters& p, const double* phi) {
  std::complex<double> sum = p.eccentricity;
  for (int i = 0; i < p.balls; ++i) sum += std::polar(p.mass[i], phi[i]);
  return std::abs(sum);
}

void expect_none(const Parameters& p) {
  const auto states = balanced_states(p);
  EXPECT_EQ(states.kind, Kind::none);
  EXPECT_TRUE(states.angles.empty());
  EXPECT_FALSE(states.reason.empty());
}

void expect_isolated(const Parameters& p, std::size_t count) {
  const auto states = balanced_states(p);
  ASSERT_EQ(states.kind, Kind::isolated);
  ASSERT_EQ(states.angles.size(), count);
  EXPECT_TRUE(states.reason.empty());
  // Rounding of the cosines; where the polygon is flat (one state), an angle is only accurate to the root of that.
  for (const auto& phi : states.angles) EXPECT_LT(unbalance(p, phi.data()), 1e-15 * (count == 2 ? 1.0 : 10.0));
}

TEST(BalancedStates, OfOneBallExistOnlyIfItWeighsWhatTheUnbalanceDoes) {
  expect_isolated(rotor(0.01, {0.01}), 1);
  EXPECT_EQ(balanced_states(rotor(0.01, {0.01})).angles[0][0], pi);
  expect_none(rotor(0.01, {0.02}));
  expect_none(rotor(0.02, {0.01}));
  expect_none(rotor(0.0, {0.01}));
}

TEST(BalancedStates, OfTwoEqualBallsAreMirrorImages) {
  const Parameters p = rotor(0.01, {0.05, 0.05});
  expect_isolated(p, 2);
  const auto states = balanced_states(p);
  const double expected = std::acos(-0.01 / 0.1);
  EXPECT_NEAR(expected, 1.67096, 5e-6);  // the recorded angle, as printed
  // A few roundings of the arc cosine and its argument.
  EXPECT_NEAR(states.angles[0][0], expected, 1e-15);
  EXPECT_NEAR(states.angles[0][1], -expected, 1e-15);
  EXPECT_EQ(states.angles[1][0], -states.angles[0][0]);
  EXPECT_EQ(states.angles[1][1], -states.angles[0][1]);
}

TEST(BalancedStates, OfTwoUnequalBallsSatisfyTheLawOfCosines) {
  const Parameters p = rotor(0.03, {0.05, 0.04});
  expect_isolated(p, 2);
  for (const auto& phi : balanced_states(p).angles) {
    // Triangle with sides 3, 4, 5: ball 2 is perpendicular to the heavy side, ball 1 closes it. Rounding only.
    EXPECT_NEAR(std::cos(phi[0]), -0.6, 1e-15);
    EXPECT_NEAR(std::cos(phi[1]), 0.0, 1e-15);
    EXPECT_LT(std::sin(phi[0]) * std::sin(phi[1]), 0.0);
  }
}

TEST(BalancedStates, OfTwoBallsMergeWhereTheTriangleIsFlat) {
  expect_isolated(rotor(0.1, {0.06, 0.04}), 1);   // together opposite the heavy side
  expect_isolated(rotor(0.01, {0.05, 0.04}), 1);  // on one line, the lighter one on the heavy side
  expect_isolated(rotor(0.01, {0.04, 0.05}), 1);
  expect_isolated(rotor(0.1, {0.05, 0.05}), 1);
}

TEST(BalancedStates, AreRuledOutByThePolygonInequality) {
  expect_none(rotor(0.11, {0.05, 0.05}));
  expect_none(rotor(0.01, {0.05, 0.03}));  // heavy enough together, yet ball 1 outweighs the rest
  expect_none(rotor(0.2, {0.05, 0.05, 0.05}));
  expect_none(rotor(0.01, {0.2, 0.05, 0.05}));
  expect_none(rotor(0.01, {0.05, 0.05, 0.05, 0.05, 0.3}));
}

TEST(BalancedStates, WithoutUnbalanceFormAFamilyIfTheBallsBalanceEachOther) {
  EXPECT_EQ(balanced_states(rotor(0.0, {0.05, 0.05})).kind, Kind::continuum);
  EXPECT_EQ(balanced_states(rotor(0.0, {0.05, 0.06, 0.07})).kind, Kind::continuum);
  expect_none(rotor(0.0, {0.05, 0.04}));
  expect_none(rotor(0.0, {0.2, 0.05, 0.06}));
}

TEST(BalancedStates, DoNotExistUnderGravity) {
  Parameters p = rotor(0.01, {0.05, 0.05});
  p.gravity = 1e-3;
  expect_none(p);
}

TEST(BalancedStates, OfALoneBallSayWhatItCancels) {
  for (const double unbalance : {0.01, 0.09})
    EXPECT_EQ(balanced_states(rotor(unbalance, {0.05})).reason,
              "one ball alone cancels its own unbalance, neither more nor less");
}

TEST(BalancedStates, DoNotDependOnTheSupports) {
  Parameters p = rotor(0.01, {0.05, 0.05});
  p.stiffness = {1.0, 2.0};
  p.damping = {0.1, 0.7};
  expect_isolated(p, 2);
}

TEST(BalancedStates, OfThreeBallsOrMoreAreFoundNearAnyGenericStart) {
  for (int n = 3; n <= equipoise::model::max_balls; ++n) {
    Parameters p = rotor(0.01, {});
    p.balls = n;
    for (int i = 0; i < n; ++i) p.mass[i] = 0.03 + 0.002 * i;
    EXPECT_EQ(balanced_states(p).kind, Kind::continuum);
    double phi[equipoise::model::max_balls];
    for (int i = 0; i < n; ++i) phi[i] = 2.0 * pi * i / n + 0.3 * std::sin(3.0 * i);
    ASSERT_TRUE(equipoise::model::project_to_balanced(p, phi)) << n << " balls";
    // Rounding of the sum of the masses.
    EXPECT_LT(unbalance(p, phi), 4e-15 * (p.eccentricity + p.total_mass())) << n << " balls";
  }
}

TEST(ProjectionToBalanced, MovesABalancedStateNotAtAllAndANeighbourLittle) {
  const Parameters p = rotor(0.01, {0.05, 0.05, 0.06});
  double phi[] = {0.3, 2.4, 4.4};
  ASSERT_TRUE(equipoise::model::project_to_balanced(p, phi));
  double again[] = {phi[0], phi[1], phi[2]};
  ASSERT_TRUE(equipoise::model::project_to_balanced(p, again));
  for (int i = 0; i < 3; ++i) EXPECT_EQ(again[i], phi[i]);
  double near[] = {phi[0] + 1e-3, phi[1] - 1e-3, phi[2] + 2e-3};
  ASSERT_TRUE(equipoise::model::project_to_balanced(p, near));
  // At most as long as the way back to its original state, 2.45e-3, since it is the nearest member.
  EXPECT_LT(std::hypot(near[0] - phi[0] - 1e-3, near[1] - phi[1] + 1e-3, near[2] - phi[2] - 2e-3), 2.45e-3);
}

TEST(ProjectionToBalanced, FindsTheSameMemberHoweverOftenBallsHaveTurned) {
  const Parameters p = rotor(0.01, {0.05, 0.05, 0.06});
  double phi[] = {0.3, 2.4, 4.4}, turned[] = {0.3 - 2e4 * pi, 2.4 + 2e3 * pi, 4.4};
  ASSERT_TRUE(equipoise::model::project_to_balanced(p, phi));
  ASSERT_TRUE(equipoise::model::project_to_balanced(p, turned));
  // The digits left after so many turns.
  EXPECT_NEAR(turned[0] + 2e4 * pi, phi[0], 1e-10);
  EXPECT_NEAR(turned[1] - 2e3 * pi, phi[1], 1e-11);
}

TEST(ProjectionToBalanced, GivesUpWhereThereIsNoBalancedState) {
  double phi[] = {0.1, 2.0, 4.0};
  EXPECT_FALSE(equipoise::model::project_to_balanced(rotor(0.2, {0.05, 0.05, 0.05}), phi));
}

}  // namespace balanced_state_test
