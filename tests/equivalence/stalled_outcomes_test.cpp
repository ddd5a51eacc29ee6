// Rotors that gravity holds against their motor: starts decided as stalled, followed far beyond without a rule, one by
// one in doubles; where they rest, and how soon that is known.
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "machine_follow.hpp"

namespace stalled_outcomes_test {

using namespace equipoise;

constexpr std::size_t starts = 48;

struct Case {
  std::string name;
  std::vector<std::string> changes;
  std::size_t places = 1;  // attractors at rest
  double latest = 150.0;   // time by which the last start is decided
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> cases() {
  return {
      {"from_the_start", {}},
      {"little_is_missing", {"speed.torque.stall=0.0195"}, 1, 400.0},
      // Twice the energy needed to turn over.
      {"after_some_turns",
       {"speed.torque.stall=0.002", "speed.initial=0.6", "rotor.damping=3", "balancer.drag=1"},
       1,
       400.0},
      {"unequal_supports_off_centre", {"rotor.stiffness=[1,1.3]", "balancer.race_offset=[0.05,0.1]"}},
      {"three_balls", {"balancer.balls=3"}},
      {"contact_in_two_orders", {"balancer.contact_angle=0.3", "balancer.mass=[0.05,0.1]"}, 2, 600.0},
      {"dry_friction", {"balancer.rolling=0.01"}, 1, 3000.0},
      {"dry_friction_and_contact", {"balancer.rolling=0.01", "balancer.contact_angle=0.3"}, 1, 3000.0},
      // Held balls may outweigh the rotor's heavy side: some rotors never release them.
      {"balls_held", {"release.speed=1.0"}, 1, 1e5},
  };
}

Study study_of(const Case& c) {
  const std::string toml =
      "[rotor]\neccentricity = 0.1\ndamping = 0.5\ninertia = 0.5\ngravity = 0.2\n"
      "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n"
      "[speed]\nprofile = \"torque\"\ninitial = 0.0\ntorque = { stall = 0.01, no_load_speed = 2.4 }\n";
  std::vector<std::string> changes = c.changes;
  changes.push_back(fmt::format("sampling.starts={}", starts));
  return parse_study(toml, c.name, changes);
}

class StalledOutcomes : public testing::TestWithParam<Case> {};

TEST_P(StalledOutcomes, StandStillForGood) {
  const Study study = study_of(GetParam());
  std::vector<Outcome> outcomes;
  BasinOptions options;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  const BasinResult result = basin(study, options);
  ASSERT_EQ(outcomes.size(), starts);
  std::size_t standing = 0;
  std::set<int> places;
  for (std::size_t i = 0; i < starts; ++i) {
    const Outcome& outcome = outcomes[i];
    EXPECT_NE(outcome.kind, OutcomeKind::undecided) << i;
    EXPECT_LT(outcome.time, GetParam().latest) << i;
    if (outcome.kind != OutcomeKind::stalled || std::fabs(outcome.mean_speed) > 1e-6) continue;
    ++standing;
    EXPECT_EQ(outcome.by, DecidedBy::validated) << i;
    places.insert(outcome.attractor);
    const auto seen = machine_follow::follow(study, i, 4.0 * outcome.time + 4000.0);
    ASSERT_FALSE(seen.lost);
    EXPECT_LT(std::fabs(seen.speed), 1e-6) << i;  // of 2000 time units or more: within a thousandth of a turn
    EXPECT_LT(seen.last_r, 1e-4) << i;            // the slowest rate is 0.005
    for (int k = 0; k < study.parameters.balls; ++k) EXPECT_LT(std::fabs(seen.turned[k]), 0.1) << i;
  }
  EXPECT_GE(standing, starts / 3);
  EXPECT_EQ(places.size(), GetParam().places);
}

INSTANTIATE_TEST_SUITE_P(Case, StalledOutcomes, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

BasinResult basin_of(const std::string& speed, const std::vector<std::string>& changes) {
  return basin(parse_study("[rotor]\neccentricity = 0.01\ndamping = 0.5\ninertia = 0.5\n"
                           "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n" +
                               speed,
                           "held", changes),
               {});
}

// A rotor that is steady before the release, or before full torque, has not ended.
TEST(HeldBalls, WaitForTheirTime) {
  const BasinResult result = basin_of("[speed]\nprofile = \"torque\"\ntorque = { stall = 1.0, no_load_speed = 2.4 }\n",
                                      {"release.time=3000", "sampling.starts=16"});
  EXPECT_EQ(result.undecided.count, 0u);
  EXPECT_EQ(result.stalled->count, 0u);
}

TEST(HeldBalls, WaitForTheirMotor) {
  const BasinResult result = basin_of(
      "[speed]\nprofile = \"torque\"\ninitial = 0.1\n"
      "torque = { gain = 0.5, target = { profile = \"points\", times = [0.0, 3000.0, 3100.0], speeds = [0.1, 0.1, 2.4] "
      "} }\n",
      {"release.speed=2.0", "sampling.starts=16"});
  EXPECT_EQ(result.undecided.count, 0u);
  EXPECT_EQ(result.stalled->count, 0u);
}

}  // namespace stalled_outcomes_test
