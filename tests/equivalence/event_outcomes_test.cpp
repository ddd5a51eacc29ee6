// Starts of systems with events, decided by attractor, against the same starts followed twenty times as long without
// decisions; unbalance left by stuck balls, against a direct run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <string>
#include <vector>

#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace event_outcomes_test {

using namespace equipoise;

const std::string heavy = "[rotor]\neccentricity = 0.01\ndamping = 0.5\n";
const std::string two = "[balancer]\nballs = 2\nmass = 0.05\ndrag = 0.05\n",
                  three = "[balancer]\nballs = 3\nmass = 0.03\ndrag = 0.05\n",
                  quick_three = "[balancer]\nballs = 3\nmass = 0.05\ndrag = 0.3\n";
const std::string constant = "[speed]\nprofile = \"constant\"\nspeed = 2.4\n",
                  motor = "[speed]\nprofile = \"torque\"\ninitial = 0.0\ntorque = { constant = 0.3, slope = -0.1 }\n";
const std::string contact = "contact_angle = 0.3\n", sticks = "rolling = 1e-3\nstiction = 2e-3\n";

struct Case {
  std::string name, toml;
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::vector<Case> cases() {
  return {
      {"contact", heavy + two + contact + constant},
      {"contact_and_stiction", heavy + two + contact + sticks + constant},
      {"stiction", heavy + two + sticks + constant},
      {"contact_of_three", heavy + three + contact + constant},
      {"contact_motor", heavy + "inertia = 0.5\n" + two + contact + motor},
      {"stiction_motor", heavy + "inertia = 0.5\n" + two + sticks + motor},
      {"contact_gravity", heavy + "gravity = 0.01\n" + two + contact + constant},
      {"contact_of_three_gravity",
       heavy + "gravity = 0.05\n" + quick_three + contact + "[speed]\nprofile = \"constant\"\nspeed = 6.0\n"},
      {"stiction_gravity", heavy + "gravity = 0.01\n" + two + sticks + constant},
      {"stiction_off_centre", heavy + two + sticks + "race_offset = [0.005, 0.002]\n" + constant},
  };
}

BasinResult run(Study study, std::uint64_t starts) {
  study.sampling.starts = starts;
  BasinOptions options;
  options.threads = 1;
  options.keep_starts = true;
  return basin(study, options);
}

class EventOutcomes : public testing::TestWithParam<Case> {};

TEST_P(EventOutcomes, HoldTwentyTimesLater) {
  constexpr std::uint64_t starts = 24;  // three blocks of the widest lanes; 240 in all
  Study study = parse_study(GetParam().toml, GetParam().name);
  const BasinResult early = run(study, starts);
  double longest = 0.0;
  for (std::size_t i = 0; i < starts; ++i)
    if (early.every_start->outcome[i] > 0) longest = std::max(longest, early.every_start->decision_time[i]);
  study.numerics.decide = ClassificationMode::horizon;
  study.numerics.horizon = std::min(20.0 * std::max(longest, 200.0), 60000.0);
  const BasinResult late = run(study, starts);
  int undecided = 0;
  for (std::size_t i = 0; i < starts; ++i) {
    const int then = late.every_start->outcome[i], now = early.every_start->outcome[i];
    undecided += now == 0;
    if (now == 0 || then == 0) continue;  // unnamed at the horizon is no contradiction
    EXPECT_EQ(now, then) << "start " << i;
  }
  EXPECT_LE(undecided, 1);
}

INSTANTIATE_TEST_SUITE_P(Of, EventOutcomes, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// Every start followed alone, in doubles, until its balls rest.
TEST(UnbalanceLeft, HasTheQuantilesOfADirectRun) {
  const Study study = parse_study(heavy + two + sticks + constant, "stuck");
  constexpr std::uint64_t starts = 120;
  const BasinResult result = run(study, starts);
  const auto balanced =
      std::find_if(result.attractors.begin(), result.attractors.end(), [](const OutcomeShare& a) { return a.id == 1; });
  ASSERT_NE(balanced, result.attractors.end());
  EXPECT_EQ(balanced->name, "balanced, stuck");
  ASSERT_EQ(balanced->unbalance.size(), unbalance_quantiles.size());
  const model::System system = study.system();
  const Sampler sampler = sampler_of(study);
  std::vector<double> left;
  for (std::uint64_t i = 0; i < starts; ++i) {
    if (result.every_start->outcome[i] != 1) continue;
    Eigen::VectorXd z(system.dimension());
    initial_state(start_of(study, sampler, study.sampling.seed, i), study.parameters.balls, system.speed(), z.data());
    EventLog log;
    ASSERT_EQ(follow_events(system, z, 1000.0, 1e-9, log), IntegrationStatus::done);
    left.push_back(std::abs(model::unbalance(study.parameters, z.data() + model::index::phi(0))));
  }
  ASSERT_EQ(left.size(), balanced->share.count);
  std::sort(left.begin(), left.end());
  // A ball's stopping place depends on its whole way, and lanes err by 1e-6 per step: 1e-3 where ways diverge.
  for (std::size_t k = 0; k < unbalance_quantiles.size(); ++k) {
    const auto rank =
        static_cast<std::size_t>(std::ceil(unbalance_quantiles[k] * static_cast<double>(left.size()))) - 1;
    EXPECT_NEAR(balanced->unbalance[k], left[rank], 1e-3) << unbalance_quantiles[k];
  }
}

// Attractors along a parameter: contact ends where balls become small; stuck balls remain one motion.
TEST(BranchesWithEvents, FollowWhatTouchesAndWhatSticks) {
  const Study study = parse_study(heavy + two + sticks + constant, "along");
  ContinuationOptions options;
  options.threads = 1;
  const BranchesResult result =
      follow_attractors(study, ParameterLine(study, "balancer.stiction=0.002:0.003:0.0005"), options);
  ASSERT_FALSE(result.branches.empty());
  bool stuck = false;
  for (const Branch& branch : result.branches)
    stuck = stuck || (branch.name == "balanced, stuck" && branch.points.size() == 3);
  EXPECT_TRUE(stuck);
}

}  // namespace event_outcomes_test
