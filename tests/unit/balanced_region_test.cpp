// Balanced regions, images of cycles, and the search for the highest level. (orbit_region_test.cpp tests what searches
// find.)
#include <array>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "../support/parameters.hpp"

namespace equipoise {
namespace balanced_region_test {

using Eigen::VectorXd;

// Two of three balls are alike: images of a motion exchange only these, or their trapping regions would lie where there
// is no motion. From a row of the table the flow stays on the table, except for chords: their errors are 3e-4 of a
// swing of less than a radian, and V is of the order of |d|^2.
TEST(OrbitRegions, ImagesExchangeLikeBallsOnly) {
  model::Parameters p = base_rotor(3);
  p.mass[2] = 0.03;
  const model::System system(p, 2.4);
  constexpr std::array phi{31.1, 52.2, 6.4};  // comes to "2 captured, 1 drifting", one of the like balls
  const auto motion = motion_from(system, model::centred_state(p, phi.data()));
  ASSERT_TRUE(motion);
  ASSERT_EQ(motion->kind, MotionKind::periodic);
  ASSERT_EQ(motion->copies, 2);
  const auto images = exchange_images(system, *motion);
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[1], (BallOrder{1, 0, 2}));
  const auto regions = orbit_regions(system, *motion, 8);
  ASSERT_EQ(regions.size(), 2u);
  for (const OrbitRegion& region : regions) {
    const auto later = advance_state(system, region.nodes[0].state, 0.37 * motion->period);
    ASSERT_TRUE(later);
    EXPECT_LT(value(system, region, later->data(), 0.0), 1e-5);
  }
}

// Supports that are almost equal: eigenvalues and Floquet multipliers must give the same rates. The difference of 1e-9
// changes them by as much, integration (1e-12 per step) by less; rates are 1e-3 and more.
TEST(BalancedAnalysis, IsTheSameWhicheverTheSection) {
  for (const double speed : {1.5, 2.4, -3.0})
    for (const int balls : {1, 2, 4}) {
      model::Parameters p = base_rotor(balls);
      if (balls == 1) p.mass[0] = p.eccentricity;
      model::Parameters almost = p;
      almost.stiffness[1] += 1e-9;
      const BalancedAnalysis flow = analyse_balanced({p, speed}), map = analyse_balanced({almost, speed});
      EXPECT_EQ(flow.stable, map.stable) << speed << ", " << balls;
      EXPECT_EQ(flow.motions.size(), map.motions.size());
      EXPECT_EQ(flow.note.empty(), map.note.empty());
      EXPECT_EQ(map.regions.size(), 0u);
      if (flow.continuum) continue;  // each section draws as many members as it can afford
      EXPECT_NEAR(flow.slowest_rate, map.slowest_rate, 1e-6) << speed << ", " << balls;
      EXPECT_NEAR(flow.growth_rate, map.growth_rate, 1e-6) << speed << ", " << balls;
    }
}

TEST(BalancedAnalysis, StatesOnALevelHaveThatValue) {
  const model::Parameters p = base_rotor(2);
  const BalancedAnalysis analysis = analyse_balanced({p, 2.4});
  ASSERT_EQ(analysis.regions.size(), 2u);
  Directions random(model::dimension(2));
  for (const BalancedRegion& region : analysis.regions)
    for (int k = 0; k < 10; ++k) {
      const VectorXd z = state_on_level(region, 0.5 * region.level, random.next());
      VectorXd d = z - model::centred_state(p, region.angles());
      EXPECT_NEAR(d.dot(form_of(region) * d), 0.5 * region.level, 1e-9 * region.level);
      for (Eigen::Index i = 0; i < d.size(); ++i) EXPECT_LT(std::fabs(d[i]), region.reach[i]);
    }
}

TEST(LevelLadder, HighestGoodLevelIsFoundAndHalved) {
  const auto below = [](double limit) { return [limit](double level, const TryRange&) { return level < limit; }; };
  EXPECT_DOUBLE_EQ(highest_good_level({16.0}, {}, below(100.0)), 8.0);
  EXPECT_DOUBLE_EQ(highest_good_level({16.0}, {}, below(1.5)), 8.0 * std::pow(2.0, -28.0 / 8.0));
  EXPECT_DOUBLE_EQ(highest_good_level({16.0, 3}, {}, below(1.5)), 0.0);
  EXPECT_DOUBLE_EQ(highest_good_level({16.0, 0}, {}, below(100.0)), 0.0);
  // Many tries find what a few miss: each of these tries fails above its own level. At the end all are made on the
  // level found.
  const std::map<std::size_t, double> limits{{200, 3.0}, {700, 0.9}, {1900, 1.2}, {3900, 0.3}, {4095, 2.0}};
  std::map<double, std::set<std::size_t>> tried;
  const double found = highest_good_level({16.0}, {}, [&](double level, const TryRange& tries) {
    bool all = true;
    for (std::size_t i = tries.first; i < tries.first + tries.count; ++i) {
      if (tries.of == 4096) tried[level].insert(i);
      if (const auto limit = limits.find(i); limit != limits.end()) all = all && level < limit->second;
    }
    return all;
  });
  EXPECT_LT(2.0 * found, 0.3);
  EXPECT_GE(2.0 * found, 0.3 * std::pow(2.0, -1.0 / 8.0));
  EXPECT_EQ(tried[2.0 * found].size(), 4096u);
}

// Where no try fails, only the highest level is tried, with every try once in addition to the first few.
TEST(LevelLadder, TheHighestLevelIsTriedFirst) {
  std::size_t made = 0;
  const auto counted = [&](double, const TryRange& tries) { return made += tries.count, true; };
  EXPECT_DOUBLE_EQ(highest_good_level({16.0}, {}, counted), 8.0);
  EXPECT_EQ(made, 128u + 4096u);
}

// Tries of the first part that go far all fail above 1: a few of them show it before other parts are tried.
TEST(LevelLadder, AFewTriesGoFarBeforeTheOthersAreAsked) {
  std::size_t failed = 0, above = 0;
  const double found = highest_good_level({16.0}, {.first_goes_far = true}, [&](double level, const TryRange& tries) {
    const bool far = tries.first == 0 && tries.of == 4096, good = !(far && level > 1.0);
    if (!good) failed += tries.count;
    if (tries.first > 0 && level > 1.0) above += tries.count;
    return good;
  });
  EXPECT_DOUBLE_EQ(found, 0.5);
  EXPECT_EQ(failed % 128, 0u);
  EXPECT_LE(failed, 10u * 128u);  // steps 1, 2, 4 ... down the ladder, and halvings between the last two
  EXPECT_EQ(above, 0u);
}

// Wherever the search begins, all tries pass on the level found, and far fewer are made from a good beginning.
TEST(LevelLadder, ANeighboursLevelIsABeginningOnly) {
  constexpr double limit = 0.3;
  const auto search = [&](double near, std::size_t& tries_made) {
    std::map<double, std::set<std::size_t>> tried;
    const double found = highest_good_level(
        {16.0}, {},
        [&](double level, const TryRange& tries) {
          tries_made += tries.count;
          for (std::size_t i = tries.first; tries.of == 4096 && i < tries.first + tries.count; ++i)
            tried[level].insert(i);
          return level < limit;
        },
        near);
    EXPECT_EQ(tried[2.0 * found].size(), 4096u) << near;
    return found;
  };
  std::size_t cold = 0, warm = 0;
  const double found = search(0.0, cold);
  EXPECT_EQ(search(found, warm), found);
  EXPECT_LT(warm, 4096u + 256u);
  for (const double near : {1e-6, 0.01 * found, 0.5 * found, 0.9 * found, 1.1 * found, 3.0 * found, 100.0, 1e6}) {
    std::size_t made = 0;
    const double from_there = search(near, made);
    EXPECT_LT(2.0 * from_there, limit) << near;
    // No higher level is searched for within six steps.
    EXPECT_GE(from_there, found * std::pow(2.0, -6.0 / 8.0) * (1.0 - 1e-12)) << near;
  }
  const auto none = [](double, const TryRange&) { return false; };
  EXPECT_EQ(highest_good_level({16.0}, {}, none, 1.0), 0.0);
  EXPECT_EQ(highest_good_level({16.0, 0}, {}, none, 1.0), 0.0);
}

}  // namespace balanced_region_test
}  // namespace equipoise
