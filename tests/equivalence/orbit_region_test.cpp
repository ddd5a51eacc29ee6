// Trapping regions of the motions that a search finds, with the phase from a ball or the rotor: V against trajectories,
// and their rules.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"

namespace equipoise {
namespace orbit_region_test {

using Eigen::VectorXd;

model::Parameters on_other_supports(model::Parameters p, double gravity) {
  p.gravity = gravity;
  p.stiffness = {1.0, 1.3};
  return p;
}

struct Found {
  Found(const model::Parameters& p, double speed)
      : system(p, speed), all(search_attractors(study_of(p, speed), {.threads = 2})) {
    for (const Attractor& a : all.catalogue.attractors())
      for (OrbitRegion& region : orbit_regions(system, a.motion, a.id)) regions.push_back({&a, std::move(region)});
  }
  struct Trap {
    const Attractor* of;
    OrbitRegion region;
  };
  model::System system;
  AttractorSearch all;
  std::vector<Trap> regions;
};

const Found& by_ball() {
  static const Found found(base_rotor(2), 2.4);
  return found;
}
const Found& by_rotor() {
  static const Found found(on_other_supports(base_rotor(2), 0.01), 2.4);
  return found;
}

// The rotor's angle at the start of a row.
double psi_of(const Found& found, const OrbitRegion& region, int row) {
  return region.clock == OrbitRegion::rotor ? found.system.section_angle() / region.cells * (row % region.cells) : 0.0;
}

TEST(OrbitRegions, ArePhasedByTheRotorOnlyWhereItsAngleMatters) {
  ASSERT_FALSE(by_ball().regions.empty());
  ASSERT_FALSE(by_rotor().regions.empty());
  for (const auto& [of, region] : by_ball().regions) EXPECT_NE(region.clock, OrbitRegion::rotor) << of->name;
  for (const auto& [of, region] : by_rotor().regions) EXPECT_EQ(region.clock, OrbitRegion::rotor) << of->name;
}

// At the start of a row nothing is interpolated except, in a ball's table, the form: one per cell, and rounding of the
// angle may select the previous cell. Between neighbouring cells of 128 per turn, a form with a few harmonics changes
// by a few percent.
TEST(OrbitRegions, StatesOnALevelHaveThatValue) {
  constexpr double level = 1e-4;
  for (const Found* found : {&by_ball(), &by_rotor()})
    for (const auto& [of, region] : found->regions) {
      const double within = region.clock == OrbitRegion::rotor ? 1e-9 : 0.1;
      Directions random(directions(region));
      for (int row = 0; row < region.rows(); row += 7) {
        const VectorXd z = state_on_level(region, row, level, random.next());
        EXPECT_NEAR(value(found->system, region, z.data(), psi_of(*found, region, row)), level, within * level)
            << of->name << ", row " << row;
      }
    }
}

// V is a sum of squares that fall at least as fast as e^(2 rate t): to e^-6 in three times 1 / rate if there were only
// the slowest mode. A twentieth leaves a factor of twenty for second-order terms and for chords.
TEST(OrbitRegions, ValuesFallAlongTheFlow) {
  constexpr double level = 1e-4, share = 0.05;
  for (const Found* found : {&by_ball(), &by_rotor()})
    for (const auto& [of, region] : found->regions) {
      const double time = 3.0 / -of->motion.orbit.slowest_rate();
      Directions random(directions(region));
      for (int k = 0; k < 3; ++k) {
        const int row = k * region.rows() / 3;
        const double psi = psi_of(*found, region, row);
        const VectorXd z = state_on_level(region, row, level, random.next());
        const auto later = advance_state(found->system, z, time, psi);
        ASSERT_TRUE(later);
        EXPECT_LT(value(found->system, region, later->data(), psi + found->system.speed() * time), share * level)
            << of->name << ", row " << row;
      }
    }
}

// Exchanging equal balls does not change the rotor's trapping region; it maps a ball's region to its image.
TEST(OrbitRegions, ExchangeOfEqualBallsIsNoDifference) {
  constexpr double level = 1e-4;
  const BallOrder other{1, 0};
  for (const Found* found : {&by_ball(), &by_rotor()})
    for (const auto& [of, region] : found->regions) {
      Directions random(directions(region));
      const VectorXd z = state_on_level(region, 5, level, random.next()), swapped = z(exchanged_components(2, other));
      const double psi = psi_of(*found, region, 5), v = value(found->system, region, z.data(), psi);
      EXPECT_DOUBLE_EQ(value(found->system, exchanged(region, 2, other), swapped.data(), psi), v) << of->name;
      if (region.clock != OrbitRegion::rotor) continue;
      EXPECT_DOUBLE_EQ(value(found->system, region, swapped.data(), psi), v) << of->name;
    }
}

// The rule catches every motion that it was made for, and its exchange image.
TEST(OrbitRegions, RulesCatchTheirMotions) {
  const Found& found = by_rotor();
  ASSERT_TRUE(found.all.rule.section.regions);
  for (const auto& [of, region] : found.regions) {
    const VectorXd z = of->motion.state, swapped = z(exchanged_components(2, {1, 0}));
    EXPECT_EQ(found.all.rule.section.regions->ask(z.data(), 0.0, nullptr).attractor, of->id) << of->name;
    EXPECT_EQ(found.all.rule.section.regions->ask(swapped.data(), 0.0, nullptr).attractor, of->id) << of->name;
  }
  EXPECT_FALSE(by_ball().all.rule.cycles.empty());
  EXPECT_FALSE(by_ball().all.rule.section.regions);
  EXPECT_TRUE(found.all.rule.cycles.empty());
}

}  // namespace orbit_region_test
}  // namespace equipoise
