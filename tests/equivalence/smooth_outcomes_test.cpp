// Outcomes of motors and off-centre races, decided on lanes, against the same starts followed one by one in doubles for
// ten times as long without a rule, and described by means and extremes alone (machine_follow.hpp).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "machine_follow.hpp"

namespace smooth_outcomes_test {

using equipoise::Outcome;
using equipoise::OutcomeKind;
using equipoise::parse_study;
using equipoise::Study;

constexpr std::size_t starts = 60;

struct Case {
  std::string name, toml;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> cases() {
  const std::string heavy = "[rotor]\neccentricity = 0.01\ndamping = 0.5\ninertia = 0.5\n",
                    gravity = "gravity = 0.01\n", two = "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n",
                    offset = "race_offset = [0.001, 0.0]\n",
                    motor = "[speed]\nprofile = \"torque\"\ntorque = { stall = 0.3, no_load_speed = 2.4 }\n",
                    control =
                        "[speed]\nprofile = \"torque\"\ntorque = { gain = 2.0, integral = 0.5, limit = 0.3, target = "
                        "{ profile = \"ramp\", final = 2.4, duration = 30.0 } }\n",
                    ramp = "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 500.0\n[release]\nspeed = 2.2\n";
  return {{"motor", heavy + two + motor},
          {"motor_with_gravity", heavy + gravity + two + motor},
          {"off_centre", heavy + two + offset + ramp},
          {"off_centre_with_gravity", heavy + gravity + two + offset + ramp},
          {"control", heavy + two + control}};
}

class SmoothOutcomes : public testing::TestWithParam<Case> {};

TEST_P(SmoothOutcomes, HoldTenTimesLater) {
  const Study study = parse_study(GetParam().toml, GetParam().name, {fmt::format("sampling.starts={}", starts)});
  std::vector<Outcome> outcomes;
  equipoise::BasinOptions options;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  const auto result = equipoise::basin(study, options);
  ASSERT_EQ(outcomes.size(), starts);
  const auto name_of = [&](const Outcome& outcome) -> std::string {
    if (outcome.kind == OutcomeKind::stalled) return "stalled";
    for (const auto& a : result.attractors)
      // Without ", period 2" and the like, which means do not show.
      if (a.id == outcome.attractor) return a.name.substr(0, a.name.find(','));
    return "?";
  };
  int undecided = 0;
  for (std::size_t i = 0; i < starts; ++i) {
    const Outcome& outcome = outcomes[i];
    undecided += outcome.kind == OutcomeKind::undecided;
    if (outcome.kind == OutcomeKind::undecided) continue;
    const double until = std::min(10.0 * std::max(300.0, outcome.time), outcome.time + 60000.0);
    const auto seen = machine_follow::follow(study, i, until);
    ASSERT_FALSE(seen.lost);
    const std::string name = name_of(outcome), then = machine_follow::kind_of(study, seen);
    EXPECT_EQ(name == "balanced" || name == "locked" ? "rest" : name, then) << "start " << i;
    // Chaos changes a mean over hundreds of time units by about one per cent.
    if (study.speed.driven()) {
      EXPECT_NEAR(outcome.mean_speed, seen.speed, 0.02 * std::fabs(seen.speed)) << "start " << i;
    }
  }
  EXPECT_LE(undecided, 1);
}
// Decided by proof, balance is known later, and nothing else changes.
TEST_P(SmoothOutcomes, AreThoseByProof) {
  const std::string& toml = GetParam().toml;
  if (toml.find("gravity") != std::string::npos) GTEST_SKIP() << "no proofs";
  const auto outcomes_by = [&](const std::string& decide) {
    std::vector<Outcome> outcomes;
    equipoise::BasinOptions options;
    options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
    equipoise::basin(
        parse_study(toml, GetParam().name, {fmt::format("sampling.starts={}", starts), "numerics.decide=" + decide}),
        options);
    return outcomes;
  };
  const std::vector<Outcome> validated = outcomes_by("validated"), proved = outcomes_by("proof");
  ASSERT_EQ(validated.size(), proved.size());
  int balanced = 0;
  for (std::size_t i = 0; i < proved.size(); ++i) {
    EXPECT_EQ(proved[i].kind, validated[i].kind) << i;
    EXPECT_EQ(proved[i].attractor, validated[i].attractor) << i;
    if (proved[i].attractor != equipoise::balanced_id) continue;
    ++balanced;
    EXPECT_EQ(proved[i].by, equipoise::DecidedBy::proof) << i;
  }
  EXPECT_GT(balanced, 0);
}

INSTANTIATE_TEST_SUITE_P(Case, SmoothOutcomes, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

}  // namespace smooth_outcomes_test
