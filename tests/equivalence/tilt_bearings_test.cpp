// Forces of single bearings of a rotor that tilts: when they are told, and what a couple does to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "equipoise/columns/watched_shaft.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/model/bearings.hpp"
#include "equipoise/reports/basin_report.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace {

using namespace tilting;

bool each_bearing(const std::vector<std::string>& overrides) {
  return watched_shaft(long_rotor_with(overrides)).bearings.has_value();
}

TEST(TiltBearings, FollowFromTheirSums) {
  const Study study = long_rotor_with({"rotor.stiffness=[1, 1.3]", "rotor.damping=[0.2, 0.3]",
                                       "rotor.tilt.stiffness={ x = [1, 7], y = [0.9, 8.7] }",
                                       "rotor.tilt.damping={ x = [0.2, 1.4], y = [0.3, 2.1] }"});
  const auto both = model::two_bearings(study.parameters, {-2.0, 3.0});
  ASSERT_TRUE(both);
  const double stiffness[2][2] = {{0.4, 0.6}, {0.6, 0.7}}, damping[2][2] = {{0.08, 0.12}, {0.12, 0.18}};
  for (int b = 0; b < 2; ++b)
    for (int d = 0; d < 2; ++d) {
      EXPECT_NEAR((*both)[b].stiffness[d], stiffness[d == 0 ? 0 : 1][b], 1e-14);
      EXPECT_NEAR((*both)[b].damping[d], damping[d == 0 ? 0 : 1][b], 1e-14);
    }
  EXPECT_FALSE(model::two_bearings(study.parameters, {-2.0, 2.9}));
  EXPECT_FALSE(model::two_bearings(study.parameters, {3.0, 3.0}));
}

TEST(TiltBearings, AreToldOneByOneWhereTheyAreAllSupports) {
  const std::string at = "rotor.tilt.bearings_at=[3, -3]";
  EXPECT_TRUE(each_bearing({at}));
  EXPECT_FALSE(each_bearing({}));
  EXPECT_FALSE(each_bearing({"rotor.tilt.bearings_at=[3, -2]"}));                // other springs
  EXPECT_FALSE(each_bearing({at, "rotor.tilt.damping=[0, 0.2]"}));               // dampers elsewhere
  EXPECT_FALSE(each_bearing({"rotor.tilt.bearings_at=[3, 0, -3]"}));             // three
  EXPECT_FALSE(each_bearing({at, "rotor.stiffness={ uniform = [0.9, 1.1] }"}));  // draws other springs
  EXPECT_TRUE(each_bearing({at, "balancer.mass={ uniform = [0.004, 0.005] }"}));
}

// With a couple alone, all supports together take next to nothing, and each bearing its share.
TEST(TiltBearings, TakeACouple) {
  const auto told = [](const std::string& bearings, double limit) {
    Study study = long_rotor_with(damped({bearings, "rotor.eccentricity=1e-9", "speed.speed=3.0", "sampling.starts=8"}));
    if (limit > 0.0) study.limits.force = limit;
    BasinOptions options;
    options.transients = true;
    return basin(study, options);
  };
  const BasinResult each = told("rotor.tilt.bearings_at=[3, -3]", 0.002), all = told("rotor.tilt.bearings_at=[3, 0, -3]", 0.0);
  ASSERT_TRUE(each.transients && each.without_balls && all.without_balls);
  const double of_each = each.without_balls->bare.figures.figure(&TransientRow::rms_force).mean,
               of_all = all.without_balls->bare.figures.figure(&TransientRow::rms_force).mean;
  EXPECT_GT(of_each, 0.002);
  EXPECT_LT(of_all, 1e-8);
  // The limit is one of a bearing, in which the couple shows. Of three it is refused.
  EXPECT_EQ(each.without_balls->bare.figures.exceeded_at_end[1]->count, 1u);
  const auto text = [](const BasinResult& r) {
    std::string t = basin_text(r, {});
    std::replace(t.begin(), t.end(), '\n', ' ');
    return t;
  };
  EXPECT_NE(text(each).find("forces are those of the bearing that takes more;"), std::string::npos) << text(each);
  EXPECT_NE(text(all).find("forces are those of all supports together;"), std::string::npos) << text(all);
}

}  // namespace
}  // namespace equipoise
