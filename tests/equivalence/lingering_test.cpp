// Balls with little drag linger near motions that they leave again: a decision must not take these for their attractor.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"

namespace equipoise {
namespace lingering_test {

// One of 700 starts comes to balls that drift at different rates (period 8.24). Wandering starts look like it for
// thousands of units before they co-drift.
const std::string wandering = R"([rotor]
eccentricity = 0.0138
damping = 0.0404
[balancer]
balls = 2
mass = 0.0584
drag = 0.0113
[speed]
profile = "constant"
speed = 3.14
[sampling]
seed = 2
)";

// One of 400 starts comes to two captured balls that swing with a period longer than a window; others swing like this
// for a while.
const std::string swinging = R"([rotor]
eccentricity = 0.019
damping = 0.134
[balancer]
balls = 2
mass = 0.0321
drag = 0.0082
[speed]
profile = "ramp"
initial = 0.0
final = 1.93
duration = 35.4
law = "published"
[sampling]
seed = 26
)";

// The attractor that start `index` is decided for; 0 if it is to be followed further.
int told(const Session& runner, std::uint64_t index) {
  Decided decided;
  EXPECT_TRUE(runner.decide(index, 1, decided));
  return decided.outcomes[0].attractor;
}

// The attractor of the very same trajectory at `end`, without earlier decisions.
int comes_to(const Study& study, const Session& runner, std::uint64_t index, double end) {
  const StartSource source(study, nullptr);
  SpunUp starts;
  EXPECT_TRUE(source.make(study.sampling.seed, index, 1, starts));
  ClassificationRule rule = runner.rule();
  rule.at_horizon = true;
  BatchTask task;
  task.parameters = &study.parameters;
  task.segment = source.segments().back();
  task.end = end;
  task.tolerance = source.tolerance();
  task.count = 1;
  task.states = starts.states.data();
  EXPECT_TRUE(classify_batch(task, rule, starts.outcomes, nullptr));
  return starts.outcomes[0].attractor;
}

// A motion must show the features by which it is recognised. A trajectory seemed stationary by features where it had
// not arrived yet.
void expect_own_features(const Session& runner) {
  for (const KnownFeatures& known : runner.rule().known) {
    const Attractor* a = runner.catalogue().find(known.attractor);
    ASSERT_TRUE(a);
    const Motion& motion = a->motion;
    if (motion.kind != MotionKind::periodic) continue;
    // Windows are grouped to 5 %; a sampled extreme misses its orbit's by less than 1 % (at least eight samples per
    // period, three times as many here).
    constexpr double agreement = 0.06;
    const double slowest = *std::min_element(motion.rate_min.begin(), motion.rate_min.begin() + 2);
    const double fastest = *std::max_element(motion.rate_max.begin(), motion.rate_max.begin() + 2);
    const double rate = std::max(std::fabs(slowest), std::fabs(fastest));
    EXPECT_NEAR(known.features[1], motion.r_max, agreement * motion.r_max) << a->name;
    EXPECT_NEAR(std::min(known.features[4], known.features[7]), slowest, agreement * rate) << a->name;
    EXPECT_NEAR(std::max(known.features[5], known.features[8]), fastest, agreement * rate) << a->name;
  }
}

TEST(Lingering, WhatWandersNearAnOrbitIsNotToldByIt) {
  const Study study = parse_study(wandering, "wandering");
  const Session runner(study, {.threads = 2});
  expect_own_features(runner);
  // At t = 5788 it seemed to have end in the orbit, and left by t = 12 000.
  constexpr std::uint64_t start = 1342;
  const int late = comes_to(study, runner, start, 20000.0);
  ASSERT_GT(late, 0);
  const int early = told(runner, start);
  EXPECT_TRUE(early == 0 || early == late) << early << ", but " << late;
}

TEST(Lingering, AShortStayNearARareMotionDecidesNothing) {
  const Study study = parse_study(swinging, "swinging");
  const Session runner(study, {.threads = 2});
  expect_own_features(runner);
  // By t = 147 it had stayed near the swing for five windows; in the end it co-drifts.
  constexpr std::uint64_t start = 115;
  const int late = comes_to(study, runner, start, 20000.0);
  ASSERT_GT(late, 0);
  EXPECT_EQ(told(runner, start), late);
}

}  // namespace lingering_test
}  // namespace equipoise
