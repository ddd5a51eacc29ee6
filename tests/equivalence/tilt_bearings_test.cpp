// Forces of single bearings of a tilting rotor: when they are told, and what a couple does to them.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "tilt_fixed_flow.hpp"

namespace equipoise {
namespace tilt_bearings_test {

using namespace tilting;

bool each_bearing(const std::vector<std::string>& overrides) {
  return !watched_shaft(long_rotor_with(overrides)).bearings.empty();
}

TEST(TiltBearings, FollowFromTheirSums) {
  const Study study = long_rotor_with({"rotor.stiffness=[1, 1.3]", "rotor.damping=[0.2, 0.3]",
                                       "rotor.tilt.stiffness={ x = [1, 7], y = [0.9, 8.7] }",
                                       "rotor.tilt.damping={ x = [0.2, 1.4], y = [0.3, 2.1] }"});
  const auto both = model::two_bearings(study.parameters, {-2.0, 3.0});
  ASSERT_EQ(both.size(), 2u);
  const double stiffness[2][2] = {{0.4, 0.6}, {0.6, 0.7}}, damping[2][2] = {{0.08, 0.12}, {0.12, 0.18}};
  for (std::size_t b = 0; b < 2; ++b)
    for (std::size_t d = 0; d < 2; ++d) {
      EXPECT_NEAR(both[b].stiffness[d], stiffness[d][b], 1e-14);
      EXPECT_NEAR(both[b].damping[d], damping[d][b], 1e-14);
    }
  EXPECT_TRUE(model::two_bearings(study.parameters, {-2.0, 2.9}).empty());
  EXPECT_TRUE(model::two_bearings(study.parameters, {3.0, 3.0}).empty());
}

// Three like springs at 3, 0 and -3 make the long rotor's supports where the outer two have all the moment, 9.
const std::string three_at = "rotor.tilt.bearings_at=[3, 0, -3]";
const std::vector<std::string> three{three_at,
                                     "rotor.tilt.stiffness=[0, 6]",
                                     "rotor.tilt.damping=[0, 0.9]",
                                     "rotor.tilt.bearings_stiffness=[0.3333333, 0.3333333, 0.3333333]",
                                     "rotor.damping=0.2",
                                     "rotor.tilt.bearings_damping=[0.05, 0.05, 0.1, 0.1, 0.05, 0.05]"};

std::vector<std::string> three_with(const std::vector<std::string>& more) {
  std::vector<std::string> all = three;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(TiltBearings, AreToldOneByOneWhereTheyAreAllSupports) {
  const std::string at = "rotor.tilt.bearings_at=[3, -3]";
  EXPECT_TRUE(each_bearing({at}));
  EXPECT_FALSE(each_bearing({}));
  EXPECT_FALSE(each_bearing({"rotor.tilt.bearings_at=[3, -2]"}));                // other springs
  EXPECT_FALSE(each_bearing({at, "rotor.tilt.damping=[0, 0.2]"}));               // dampers elsewhere
  EXPECT_FALSE(each_bearing({three_at}));                                        // whose shares are not known
  EXPECT_FALSE(each_bearing({at, "rotor.stiffness={ uniform = [0.9, 1.1] }"}));  // draws other springs
  EXPECT_TRUE(each_bearing({at, "balancer.mass={ uniform = [0.004, 0.005] }"}));
}

// One damper at one place: the determinant is zero, up to rounding.
TEST(TiltBearings, OneDamperIsTakenAnywhere) {
  for (int k = 1; k <= 40; ++k) {
    const double at = 0.1 * k, c = 0.07;
    const std::string damping = fmt::format("rotor.tilt.damping=[{}, {}]", c * at, c * at * at);
    EXPECT_NO_THROW(long_rotor_with({"rotor.damping=0.07", damping})) << damping;
  }
}

TEST(TiltBearings, MoreThanTwoAreStatedOneByOne) {
  const std::string damping = "rotor.tilt.bearings_damping=[0.1, 0, 0.1]";
  EXPECT_TRUE(each_bearing(three_with({damping, "rotor.tilt.damping=[0, 1.8]"})));
  const auto refused = [](const std::vector<std::string>& overrides, bool stated = true) -> std::string {
    try {
      long_rotor_with(stated ? three_with(overrides) : overrides);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  for (const auto& [overrides, part] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{damping}, "rotor.tilt.bearings_damping"},  // their moment is 1.8, not 0.9
           {{"rotor.tilt.stiffness=[0, 9]"},
            "must add up, with its moments about the centre of mass, to rotor.stiffness and"},
           {{"rotor.tilt.bearings_stiffness=[0.5, 0.5]"}, "of 3 numbers, one per bearing"},
           {{"rotor.tilt.bearings_stiffness=[0.5, -0.1, 0.6]"}, "entry 2 must be a finite number at least 0"},
           {{"rotor.tilt.bearings_at=[3, 0, -3, 1, 1, 1, 1, 1, 1]"}, "at most 8"}})
    EXPECT_NE(refused(overrides).find(part), std::string::npos) << part << ": " << refused(overrides);
  const std::string unknown = refused({three_at, "limits.force=0.1"}, false);
  EXPECT_NE(unknown.find("each has to be known: state rotor.tilt.bearings_stiffness"), std::string::npos) << unknown;
}

// With a couple alone, all supports together take next to nothing, and each bearing its share.
TEST(TiltBearings, TakeACouple) {
  const auto told = [](const std::string& bearings, double limit) {
    Study study =
        long_rotor_with(damped({bearings, "rotor.eccentricity=1e-9", "speed.speed=3.0", "sampling.starts=8"}));
    if (limit > 0.0) study.limits.force = limit;
    BasinOptions options;
    options.transients = true;
    return basin(study, options);
  };
  const BasinResult each = told("rotor.tilt.bearings_at=[3, -3]", 0.002), all = told(three_at, 0.0);
  ASSERT_TRUE(each.transients && each.without_balls && all.without_balls);
  const double of_each = each.without_balls->bare.figures.figure(&TransientRow::rms_force).mean,
               of_all = all.without_balls->bare.figures.figure(&TransientRow::rms_force).mean;
  EXPECT_GT(of_each, 0.002);
  EXPECT_LT(of_all, 1e-8);
  // The limit is one of a bearing, in which the couple shows.
  EXPECT_EQ(each.without_balls->bare.figures.exceeded_at_end[1]->count, 1u);
  const auto text = [](const BasinResult& r) {
    std::string t = basin_text(r);
    std::replace(t.begin(), t.end(), '\n', ' ');
    return t;
  };
  EXPECT_NE(text(each).find("forces are those of the bearing that takes most;"), std::string::npos) << text(each);
  EXPECT_NE(text(all).find("forces are those of all supports together;"), std::string::npos) << text(all);
}

}  // namespace tilt_bearings_test
}  // namespace equipoise
