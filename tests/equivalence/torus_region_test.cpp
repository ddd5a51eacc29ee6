// Trapping regions around tori: V vanishes on the torus, however the balls are numbered, and interior states stay
// inside.
#include "equipoise/classification/trapping_regions/window_region.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "../support/parameters.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"

namespace equipoise {
namespace torus_region_test {

// The torus V2 of two balls at Omega = 2.4, and its trapping region.
struct Found {
  Found() {
    const AttractorSearch all = search_attractors(study_of(system.parameters(), 2.4), {.threads = 2});
    for (const Attractor& a : all.catalogue.attractors())
      if (a.motion.kind == MotionKind::quasi_periodic) motion = a.motion;
    settings.system = &system;
    settings.threads = 2;
    if (motion.state.size() > 0) region = torus_region(system, motion, 3, settings);
  }
  model::System system{base_rotor(2), 2.4};
  Motion motion;
  TrialSettings settings;
  std::shared_ptr<const WindowRegion> region;
};

const Found& torus() {
  static const Found found;
  return found;
}

TEST(TorusRegion, SurroundsTheTorusAndNothingElse) {
  const Found& found = torus();
  ASSERT_TRUE(found.region);
  const WindowRegion& region = *found.region;
  EXPECT_EQ(region.attractor(), 3);
  EXPECT_GT(region.level(), 32.0 * region.floor());  // tries need 16
  // A trajectory begun elsewhere on the torus, and its mirror image by exchange of the balls.
  Eigen::VectorXd state = found.motion.state;
  ASSERT_EQ(follow(found.system, state, 3456.7, 1e-9), IntegrationStatus::done);
  std::vector<Eigen::VectorXd> samples;
  ASSERT_EQ(follow(found.system, state, 200.0, 1e-9, nullptr, &samples), IntegrationStatus::done);
  for (Eigen::VectorXd& s : samples) {
    EXPECT_LT(region.value(s.data()), 2.0 * region.floor());  // the floor is the largest of 512 others
    std::swap(s[4], s[5]);
    std::swap(s[6], s[7]);
    EXPECT_LT(region.value(s.data()), 2.0 * region.floor());
  }
  for (const auto& phi : model::balanced_states(found.system).angles) {
    const Eigen::VectorXd z = model::balanced_state(found.system, 2.4, phi.data());
    EXPECT_GT(region.value(z.data()), region.level());
  }
}

TEST(TorusRegion, LetsNothingOut) {
  const Found& found = torus();
  ASSERT_TRUE(found.region);
  const WindowRegion& region = *found.region;
  Directions directions(8);
  for (std::size_t k = 0; k < 40; ++k) {
    Eigen::VectorXd state = region.state_on_level(977 * k + 5, region.level(), directions.next());
    // The nearest state of the cloud may differ from the one used to make this.
    EXPECT_LT(region.value(state.data()), 1.5 * region.level());
    ASSERT_EQ(follow(found.system, state, 400.0, 1e-9), IntegrationStatus::done);
    EXPECT_LT(region.value(state.data()),
              0.01 * region.level());  // at a rate of 0.037 e^-30 is left, and the cloud's floor
  }
}

// A lane from a state, under a rule.
Fate decided(const Found& found, Eigen::VectorXd state, const ClassificationRule& rule,
             std::vector<PilotRecord>* records) {
  BatchTask task = batch_task(found.system);
  task.end = 1000.0;
  task.tolerance = 1e-8;
  task.count = 1;
  task.states = state.data();
  std::vector<Fate> fates(1);
  EXPECT_TRUE(classify_batch(task, rule, fates, records));
  return fates[0];
}

TEST(TorusRegion, IsWatchedInAudits) {
  const Found& found = torus();
  ASSERT_TRUE(found.region);
  ClassificationRule rule = rule_of_regions(found.system);
  rule.window = 16.0;
  set_window_regions(rule, {found.region});
  FeatureBox all;  // contains every window
  all.low.fill(-1e300);
  all.high.fill(1e300);
  rule.boxes = {all};
  std::vector<PilotRecord> records(1);
  const Fate at_once = decided(found, found.motion.state, rule, &records);
  EXPECT_EQ(at_once.attractor, 3);
  EXPECT_LT(at_once.time, 10.0);  // the first half window
  rule.blind = true;
  const Fate watched = decided(found, found.motion.state, rule, &records);
  EXPECT_EQ(watched.attractor, 3);
  EXPECT_EQ(watched.by, DecidedBy::validated);
  // Half windows end with a step, slightly late.
  EXPECT_NEAR(watched.time - at_once.time, 8.0 * rule.windowed.watched, 0.5 * rule.windowed.watched);
  EXPECT_GE(records[0].longest_run[0], rule.windowed.watched - 1);
}

TEST(TorusRegion, TellsWhatDoesNotBalance) {
  const Found& found = torus();
  ASSERT_TRUE(found.region);
  ClassificationRule rule = rule_of_regions(found.system);
  rule.balanced = analyse_balanced(found.system).regions;
  ASSERT_FALSE(rule.balanced.empty());
  set_window_regions(rule, {found.region});
  std::vector<double> states(found.motion.state.begin(), found.motion.state.end());
  const Eigen::VectorXd balanced = model::balanced_state(found.system, 2.4, rule.balanced[0].angles());
  states.insert(states.end(), balanced.begin(), balanced.end());
  EXPECT_EQ(come_to_balance(states, rule, found.settings, -0.024), (std::vector<char>{0, 1}));
}

TEST(TorusRegion, IsForToriOnly) {
  const Found& found = torus();
  Motion chaotic = found.motion, unstable = found.motion, slow = found.motion;
  chaotic.kind = MotionKind::chaotic;
  unstable.stable = false;
  slow.exponents[2] = -1e-4;
  for (const Motion& motion : {chaotic, unstable, slow})
    EXPECT_FALSE(torus_region(found.system, motion, 3, found.settings));
  ClassificationRule rule;
  set_window_regions(rule, {});
  EXPECT_FALSE(rule.windowed.regions);
}

}  // namespace torus_region_test
}  // namespace equipoise
