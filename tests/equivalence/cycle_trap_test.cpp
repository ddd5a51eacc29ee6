// Traps of the motions that a search finds, phased by a ball or by the rotor: V against trajectories, and their rules.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/discovery/discovery.hpp"
#include "equipoise/orbits/variational.hpp"
#include "equipoise/traps/cycle_forms.hpp"
#include "equipoise/traps/trials.hpp"

namespace equipoise {
namespace {

using Eigen::VectorXd;

model::Parameters on_other_supports(model::Parameters p, double gravity) {
  p.gravity = gravity;
  p.stiffness = {1.0, 1.3};
  return p;
}

struct Found {
  Found(const model::Parameters& p, double speed)
      : system(p, speed), all(discover(study_of(p, speed), {.threads = 2})) {
    for (const Attractor& a : all.catalogue.attractors())
      for (CycleTrap& trap : cycle_traps(system, a.motion, a.id)) traps.push_back({&a, std::move(trap)});
  }
  struct Trap {
    const Attractor* of;
    CycleTrap trap;
  };
  model::System system;
  Discovery all;
  std::vector<Trap> traps;
};

const Found& by_ball() {
  static const Found found(base_rotor(2), 2.4);
  return found;
}
const Found& by_rotor() {
  static const Found found(on_other_supports(base_rotor(2), 0.01), 2.4);
  return found;
}

// The rotor's angle where a row begins.
double psi_of(const Found& found, const CycleTrap& trap, int row) {
  return trap.clock == CycleTrap::rotor ? found.system.strobe_angle() / trap.cells * (row % trap.cells) : 0.0;
}

TEST(CycleTraps, ArePhasedByTheRotorOnlyWhereItsAngleMatters) {
  ASSERT_FALSE(by_ball().traps.empty());
  ASSERT_FALSE(by_rotor().traps.empty());
  for (const auto& [of, trap] : by_ball().traps) EXPECT_NE(trap.clock, CycleTrap::rotor) << of->name;
  for (const auto& [of, trap] : by_rotor().traps) EXPECT_EQ(trap.clock, CycleTrap::rotor) << of->name;
}

// At a row's beginning nothing is interpolated but, of a ball's table, the form: one a cell, and rounding of the angle
// may choose the cell before. From one cell to the next of 128 a turn a form with a few harmonics changes by a few
// percent.
TEST(CycleTraps, StatesOnALevelHaveThatValue) {
  constexpr double level = 1e-4;
  for (const Found* found : {&by_ball(), &by_rotor()})
    for (const auto& [of, trap] : found->traps) {
      const double within = trap.clock == CycleTrap::rotor ? 1e-9 : 0.1;
      Directions random(directions(trap));
      for (int row = 0; row < trap.rows(); row += 7) {
        const VectorXd z = state_on_level(trap, row, level, random.next());
        EXPECT_NEAR(value(found->system, trap, z.data(), psi_of(*found, trap, row)), level, within * level)
            << of->name << ", row " << row;
      }
    }
}

// V is a sum of squares that fall as e^(2 rate t), or faster: to e^-6 in three times 1 / rate if the slowest mode were
// all. A twentieth leaves a factor of twenty for terms of second order and for chords.
TEST(CycleTraps, ValuesFallAlongTheFlow) {
  constexpr double level = 1e-4, share = 0.05;
  for (const Found* found : {&by_ball(), &by_rotor()})
    for (const auto& [of, trap] : found->traps) {
      const double time = 3.0 / -of->motion.orbit.slowest_rate();
      Directions random(directions(trap));
      for (int k = 0; k < 3; ++k) {
        const int row = k * trap.rows() / 3;
        const double psi = psi_of(*found, trap, row);
        const VectorXd z = state_on_level(trap, row, level, random.next());
        const auto later = advance_state(found->system, z, time, psi);
        ASSERT_TRUE(later);
        EXPECT_LT(value(found->system, trap, later->data(), psi + found->system.speed() * time), share * level)
            << of->name << ", row " << row;
      }
    }
}

// Exchange of equal balls: of the rotor's trap it changes nothing, of a ball's it leads to the trap's image.
TEST(CycleTraps, ExchangeOfEqualBallsIsNoDifference) {
  constexpr double level = 1e-4;
  const BallOrder other{1, 0};
  for (const Found* found : {&by_ball(), &by_rotor()})
    for (const auto& [of, trap] : found->traps) {
      Directions random(directions(trap));
      const VectorXd z = state_on_level(trap, 5, level, random.next()), swapped = z(exchanged_components(2, other));
      const double psi = psi_of(*found, trap, 5), v = value(found->system, trap, z.data(), psi);
      EXPECT_DOUBLE_EQ(value(found->system, exchanged(trap, 2, other), swapped.data(), psi), v) << of->name;
      if (trap.clock != CycleTrap::rotor) continue;
      EXPECT_DOUBLE_EQ(value(found->system, trap, swapped.data(), psi), v) << of->name;
    }
}

// What the rule asks catches every motion that it was made for, and its exchange image.
TEST(CycleTraps, RulesCatchTheirMotions) {
  const Found& found = by_rotor();
  ASSERT_TRUE(found.all.rule.strobed);
  for (const auto& [of, trap] : found.traps) {
    const VectorXd z = of->motion.state, swapped = z(exchanged_components(2, {1, 0}));
    EXPECT_EQ(found.all.rule.strobed->ask(z.data(), 0.0, nullptr).attractor, of->id) << of->name;
    EXPECT_EQ(found.all.rule.strobed->ask(swapped.data(), 0.0, nullptr).attractor, of->id) << of->name;
  }
  EXPECT_FALSE(by_ball().all.rule.cycles.empty());
  EXPECT_FALSE(by_ball().all.rule.strobed);
  EXPECT_TRUE(found.all.rule.cycles.empty());
}

}  // namespace
}  // namespace equipoise
