// Windows of time: features, stationarity. (How densely they are sampled: window_sampling_test.cpp.)
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/simulation/batch/own_rotor.hpp"
#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {
namespace window_test {

WindowSums circling(double rate, double r) {
  WindowSums sums;
  sums.duration = 8.0;
  sums.r2_min = sums.r2_max = r * r;
  sums.r2_integral = 8.0 * r * r;
  sums.turned = {8.0 * rate, 0.0};
  sums.q_min = sums.q_max = {rate, 0.0};
  return sums;
}

TEST(Windows, FeaturesDoNotDependOnTheOrderOfInterchangeableBalls) {
  WindowSums a = circling(-1.0, 0.1), b = a;
  std::swap(b.turned[0], b.turned[1]);
  std::swap(b.q_min[0], b.q_min[1]);
  std::swap(b.q_max[0], b.q_max[1]);
  EXPECT_EQ(features(a, 2, true), features(b, 2, true));
  EXPECT_NE(features(a, 2, false), features(b, 2, false));
}

TEST(Windows, AMotionThatRepeatsIsStationaryAndOneThatShrinksIsNot) {
  ClassificationRule rule;
  WindowTracker steady, shrinking;
  steady.begin(rule);
  shrinking.begin(rule);
  bool repeated = false;
  for (int k = 0; k < 400; ++k) {
    repeated = repeated || steady.add(circling(-1.0, 0.1)).decided;
    // A slow approach to balance: r falls by a tenth in a hundred time units.
    EXPECT_FALSE(shrinking.add(circling(0.0, 0.1 * std::exp(-0.001 * 8.0 * k))).decided);
  }
  EXPECT_TRUE(repeated);
}

TEST(Windows, ABoxNeedsSeveralHitsInARow) {
  ClassificationRule rule;
  FeatureBox box;
  const Features centre = features(circling(-1.0, 0.1), 2, true);
  for (int i = 0; i < feature_count(2); ++i) {
    box.low[i] = centre[i] - 0.01;
    box.high[i] = centre[i] + 0.01;
  }
  box.attractor = 4;
  box.hits_needed = 3;
  rule.boxes = {box};
  WindowTracker tracker;
  tracker.begin(rule);
  const auto hit = [&] { return tracker.add(circling(-1.0, 0.1)); };
  // A window has two halves; every half but the first ends one.
  for (int half = 0; half < 3; ++half) EXPECT_FALSE(hit().decided);
  EXPECT_FALSE(tracker.add(circling(-0.5, 0.1)).decided);
  for (int half = 0; half < 3; ++half) EXPECT_FALSE(hit().decided);
  const WindowConclusion verdict = hit();
  EXPECT_TRUE(verdict.decided);
  EXPECT_EQ(verdict.attractor, 4);
  EXPECT_EQ(tracker.record().longest_run[0], 3);
}

TEST(Windows, LongWindowsNameTheKnownMotionTheyResemble) {
  const Features slow = features(circling(-1.0, 0.1), 2, true), fast = features(circling(-2.0, 0.1), 2, true);
  const std::vector<KnownFeatures> known{{slow, 3}, {fast, 5}};
  EXPECT_EQ(nearest_known(features(circling(-1.01, 0.1), 2, true), known, 2)->attractor, 3);
  EXPECT_EQ(nearest_known(features(circling(-1.98, 0.1), 2, true), known, 2)->attractor, 5);
  EXPECT_EQ(nearest_known(features(circling(-1.5, 0.1), 2, true), known, 2), nullptr);
}

// Before and after a bifurcation a motion looks alike but has two names.
TEST(Windows, OfRotorsThatDifferWhatLooksLikeTwoMotionsIsNeither) {
  const Features f = features(circling(-1.0, 0.1), 2, true), beside = features(circling(-1.001, 0.1), 2, true);
  const std::vector<KnownFeatures> known{{f, 3, false, -1, -1}, {beside, 5, false, -1, -1}};
  const std::vector<double> none(static_cast<std::size_t>(feature_count(2)), 0.0);
  EXPECT_EQ(nearest_known(f, known, 2)->attractor, 3);
  EXPECT_EQ(nearest_known(f, known, 2, none.data()), nullptr);
  EXPECT_EQ(nearest_known(f, {known[0], known[0]}, 2, none.data())->attractor, 3);
}

// What other starts of the same rotor came to. A motion that repeats must match it within the 2 % that count as no
// change.
TEST(Windows, MotionsMetBeforeNameWhatTheRuleDoesNotList) {
  const ClassificationRule rule;
  const std::vector<KnownFeatures> met{{features(circling(-1.0, 0.1), 2, true), -1},
                                       {features(circling(-2.0, 0.1), 2, true), -2, true}};
  OwnRotor rotor{model::System(model::Parameters{}, {})};
  const auto told = [&](double rate) {
    WindowTracker tracker;
    tracker.begin(rule, &rotor);
    for (int k = 0; k < 400; ++k)
      if (const WindowConclusion verdict = tracker.add(circling(rate, 0.1)); verdict.decided) return verdict.attractor;
    return 99;
  };
  EXPECT_EQ(told(-1.01), 0);
  rotor.met = &met;
  EXPECT_EQ(told(-1.01), -1);
  EXPECT_EQ(told(-1.03), 0);
  EXPECT_EQ(told(-2.06), -2);
  EXPECT_EQ(told(-3.0), 0);
}

TEST(Windows, ChaosIsKnownByWindowsThatResembleItWithoutRepeating) {
  ClassificationRule rule;
  rule.window = 16.0;
  rule.first_long_window = 64.0;
  rule.known = {{features(circling(-1.0, 0.1), 2, true), 9, true}};
  WindowTracker tracker;
  const auto decided_after = [&] {  // long windows end at 64 and its doublings; each differs from the last by 3 %
    tracker.begin(rule);
    double rate = -0.985;
    for (double t = 8.0, end = 64.0; t <= 1024.0; t += 8.0) {
      const WindowConclusion verdict = tracker.add(circling(rate, 0.1));
      if (verdict.decided) return std::pair{t, verdict.attractor};
      if (t == end) {
        rate = rate == -0.985 ? -1.015 : -0.985;
        end *= 2.0;
      }
    }
    return std::pair{0.0, 0};
  };
  EXPECT_EQ(decided_after(), (std::pair{256.0, 9}));
  rule.known.front().chaotic = false;
  EXPECT_EQ(decided_after(), (std::pair{0.0, 0}));
  EXPECT_EQ(tracker.attractor_at_end(), 9);
}

}  // namespace window_test
}  // namespace equipoise
