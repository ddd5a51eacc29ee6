// Trapping regions around motions whose phase no angle tells, and around those whose place differs between the rotors
// of a family.
#include "equipoise/classification/trapping_regions/path_region.hpp"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "../support/parameters.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/rotor_family/drawn_source.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {
namespace path_region_test {

constexpr double speed = 2.4;

Study study_with_eccentricity(double eccentricity) {
  model::Parameters p = base_rotor(2);
  p.eccentricity = eccentricity;
  Study study = study_of(p, speed);
  study.numerics.horizon = 3000.0;
  return study;
}

// The motion of a given name that a search finds; each rotor is searched once.
Motion found(const Study& study, const std::string& name) {
  static std::map<double, AttractorSearch> searched;
  AttractorSearch& all = searched[study.parameters.eccentricity];
  if (all.catalogue.attractors().empty()) all = search_attractors(study, {.threads = 2});
  for (const Attractor& a : all.catalogue.attractors())
    if (a.name == name) return a.motion;
  return {};
}

// Both "locked", at rest, and "both captured", which swings without any ball going round: at lambda = 0.11.
class OfOneRotor : public testing::TestWithParam<const char*> {
 protected:
  const Study study = study_with_eccentricity(0.11);
  const model::System system = study.system();
  const Motion motion = found(study, GetParam());
};

TEST_P(OfOneRotor, SurroundsTheMotionAndLetsNothingOut) {
  ASSERT_TRUE(motion.stable);
  const TrialSettings settings{.system = &system, .threads = 2};
  const auto region = path_region(system, motion, 7, settings, nullptr);
  ASSERT_TRUE(region);
  Eigen::VectorXd state = motion.state;
  EXPECT_GT(region->level(), 32.0 * region->floor());  // tries need 16
  // The places of exchanged balls are the same motion, and so is every time of it. The motion is refined to 1e-6.
  const double on_it = 2.0 * region->floor() + 1e-10;
  for (int k = 0; k < 40; ++k) {
    EXPECT_LT(region->value(state.data(), nullptr), on_it) << k;
    Eigen::VectorXd exchanged = state;
    std::swap(exchanged[4], exchanged[5]);
    std::swap(exchanged[6], exchanged[7]);
    EXPECT_LT(region->value(exchanged.data(), nullptr), on_it) << k;
    state = *advance_state(system, state, 3.7);
  }
  Directions directions(8);
  for (std::size_t k = 0; k < 40; ++k) {
    state = region->state_on_level(977 * k + 5, region->level(), directions.next(), nullptr);
    EXPECT_LT(region->value(state.data(), nullptr), 1.5 * region->level());
    // At the slower rate, 0.025, e^-20 of V is left.
    state = *advance_state(system, state, 400.0);
    EXPECT_LT(region->value(state.data(), nullptr), 1e-3 * region->level()) << k;
  }
  // The other attractors lie outside.
  for (const char* other : {"co-drifting", "one captured", "locked", "both captured"}) {
    if (other == std::string(GetParam())) continue;
    const Motion elsewhere = found(study, other);
    ASSERT_GT(elsewhere.state.size(), 0) << other;
    EXPECT_GT(region->value(elsewhere.state.data(), nullptr), region->level()) << other;
  }
}

INSTANTIATE_TEST_SUITE_P(PathRegion, OfOneRotor, testing::Values("locked", "both captured"),
                         [](const auto& test) { return test.param[0] == 'l' ? "Locked" : "BothCaptured"; });

TEST(PathRegion, CatchesWhatComesToTheMotionWhenFollowed) {
  const Study study = study_with_eccentricity(0.11);
  const Session runner(study, {.threads = 2});
  Decided decided;
  constexpr std::size_t count = 80;
  ASSERT_TRUE(runner.decide(0, count, decided));
  int caught = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Attractor* a = runner.catalogue().find(decided.outcomes[i].attractor);
    ASSERT_TRUE(a) << i;
    if (a->name != "locked" && a->name != "both captured") continue;
    caught += decided.outcomes[i].by == DecidedBy::validated && decided.outcomes[i].time < 400.0;
    Eigen::VectorXd state = Eigen::VectorXd::Zero(8);
    state[4] = decided.phi[2 * i];
    state[5] = decided.phi[2 * i + 1];
    const auto motion = motion_from(study.system(), state);
    ASSERT_TRUE(motion) << i;
    EXPECT_EQ(motion_name(study.parameters, *motion).name, a->name) << i;
  }
  // 70 % of all starts end in one of the two; windows would take 1500 units or more to decide.
  EXPECT_GT(caught, 40);
}

// A lane from a state, under a rule.
Outcome decided(const model::System& system, Eigen::VectorXd state, const ClassificationRule& rule,
                std::vector<PilotRecord>* records) {
  BatchTask task = batch_task(system);
  task.end = 1000.0;
  task.tolerance = 1e-8;
  task.count = 1;
  task.states = state.data();
  std::vector<Outcome> outcomes(1);
  EXPECT_TRUE(classify_batch(task, rule, outcomes, records));
  return outcomes[0];
}

// Of the paper's rotor, which balances as well.
class OfARotorThatBalances : public testing::Test {
 protected:
  const Study study = study_with_eccentricity(0.01);
  const model::System system = study.system();
  const Motion motion = found(study, "co-drifting");
  const TrialSettings settings{.system = &system, .threads = 2};
  const std::shared_ptr<const PathRegion> region = path_region(system, motion, 3, settings, nullptr);
};

TEST_F(OfARotorThatBalances, IsWatchedInAudits) {
  ASSERT_TRUE(region);
  ClassificationRule rule = rule_of_regions(system);
  rule.window = 16.0;
  set_window_regions(rule, {region});
  FeatureBox all;  // contains every window
  all.low.fill(-1e300);
  all.high.fill(1e300);
  rule.boxes = {all};
  std::vector<PilotRecord> records(1);
  const Outcome at_once = decided(system, motion.state, rule, &records);
  EXPECT_EQ(at_once.attractor, 3);
  EXPECT_LT(at_once.time, 10.0);  // the first half window
  rule.blind = true;
  const Outcome watched = decided(system, motion.state, rule, &records);
  EXPECT_EQ(watched.attractor, 3);
  EXPECT_EQ(watched.by, DecidedBy::validated);
  // Half windows end with a step, slightly late.
  EXPECT_NEAR(watched.time - at_once.time, 8.0 * rule.windowed.watched, 0.5 * rule.windowed.watched);
  EXPECT_GE(records[0].longest_run[0], rule.windowed.watched - 1);
}

TEST_F(OfARotorThatBalances, TellsWhatDoesNotBalance) {
  ASSERT_TRUE(region);
  ClassificationRule rule = rule_of_regions(system);
  rule.balanced = analyse_balanced(system).regions;
  ASSERT_FALSE(rule.balanced.empty());
  set_window_regions(rule, {region});
  std::vector<double> states(motion.state.begin(), motion.state.end());
  const Eigen::VectorXd balanced = model::balanced_state(system, speed, rule.balanced[0].angles());
  states.insert(states.end(), balanced.begin(), balanced.end());
  EXPECT_EQ(come_to_balance(states, rule, settings, -0.024), (std::vector<char>{0, 1}));
}

TEST_F(OfARotorThatBalances, IsForAttractingMotionsThatRepeat) {
  Motion chaotic = motion, unstable = motion;
  chaotic.kind = MotionKind::chaotic;
  unstable.stable = false;
  for (const Motion& other : {chaotic, unstable}) EXPECT_FALSE(path_region(system, other, 3, settings, nullptr));
  ClassificationRule rule;
  set_window_regions(rule, {});
  EXPECT_FALSE(rule.windowed.regions);
}

// Rotors from lambda = 0.095 to 0.115; "locked" exists from 0.1 on.
struct Family {
  Family() : source(family, box, nullptr) {
    rotors = source.ends();
    for (std::size_t k = 0; k < 128; ++k) rotors.push_back(source.rotor(k));
  }
  StudyFamily family{{{[](double f) { return 0.095 + 0.02 * f; }}},
                     [](std::span<const double> at) { return study_with_eccentricity(at[0]); }};
  FamilyBox box{{0.0}, {1.0}};
  DrawnSource source;
  std::vector<OwnRotor> rotors;
};

TEST(PathRegion, StandsWhereEachRotorHasTheMotion) {
  const Family all;
  // Found in the middle of the part, and at its upper end.
  for (const auto& [name, first] : {std::pair{"both captured", 0}, std::pair{"locked", 2}}) {
    const OwnRotor& own = all.rotors[static_cast<std::size_t>(first)];
    const Motion motion = found(study_with_eccentricity(own.system.parameters().eccentricity), name);
    ASSERT_TRUE(motion.stable) << name;
    const TrialSettings settings{.system = &own.system, .threads = 2, .rotors = all.rotors};
    const auto region = path_region(own.system, motion, 7, settings, &own);
    ASSERT_TRUE(region) << name;
    int holds = 0;
    for (const OwnRotor& rotor : all.rotors) {
      const double eccentricity = rotor.system.parameters().eccentricity;
      const bool locked = name == std::string("locked");
      if (!region->holds_for(rotor)) continue;
      ++holds;
      const auto there = refined_motion(rotor.system, motion);
      ASSERT_TRUE(there && there->stable) << name << ' ' << eccentricity;
      EXPECT_LT(region->value(there->state.data(), &rotor), region->floor()) << name << ' ' << eccentricity;
      EXPECT_FALSE(locked && eccentricity < 0.1);
    }
    EXPECT_GT(holds, 40) << name;
  }
}

}  // namespace path_region_test
}  // namespace equipoise
