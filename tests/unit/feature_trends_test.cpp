// How features of a motion change from rotor to rotor.
#include "equipoise/classification/rotor_family/feature_trends.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/extras/literature/published_tables.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"
#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {
namespace feature_trends_test {

// The given largest r, with balls that drift at `rate`.
Features shown(double largest, double rate) {
  Features f{};
  f[0] = 0.5 * largest;
  f[1] = largest;
  f[2] = 0.8 * largest;
  for (int i = 0; i < 2; ++i) f[3 + 3 * i] = f[4 + 3 * i] = f[5 + 3 * i] = rate;
  return f;
}

// Rotors from one end of the box to the other, changing with `slope`.
std::vector<ShownFeatures> along(double first, double slope, double rate) {
  std::vector<ShownFeatures> all;
  for (int k = 0; k <= 40; ++k) {
    const double x = k / 40.0;
    all.push_back({{x}, shown(first + slope * x, rate)});
  }
  return all;
}

OwnRotor rotor_at(double x) {
  OwnRotor rotor = own_rotor(paper_rotor().system());
  rotor.coordinates = {x};
  return rotor;
}

TEST(FeatureTrends, MotionsOfOneNameHaveOneEach) {
  FeatureTrends trends;
  const auto growing = along(0.1, 0.05, -1.0), shrinking = along(0.3, -0.1, -0.5);
  EXPECT_EQ(trends.add(2, 0.05, growing[20], growing), 0);
  EXPECT_EQ(trends.add(2, 0.05, shrinking[20], shrinking), 1);
  OwnRotor rotor = rotor_at(0.9);
  trends.place(rotor);
  // As on the middle rotor's motion.
  EXPECT_NEAR(brought_back(shown(0.145, -1.0), 0, rotor.shifts.data(), 2)[1], 0.125, 1e-9);
  EXPECT_NEAR(brought_back(shown(0.21, -0.5), 1, rotor.shifts.data(), 2)[1], 0.25, 1e-9);
}

TEST(FeatureTrends, TooFewThatStayMakeNone) {
  FeatureTrends trends;
  const auto all = along(0.1, 0.05, -1.0);
  EXPECT_EQ(trends.add(2, 0.05, all[20], {all[20]}), -1);
  OwnRotor rotor = rotor_at(0.9);
  trends.place(rotor);
  EXPECT_TRUE(rotor.shifts.empty());
}

// Rotors that went elsewhere do not distort it.
TEST(FeatureTrends, IsThatOfTheRotorsThatStayed) {
  FeatureTrends trends;
  auto mixed = along(0.1, 0.05, -1.0);
  for (int k = 30; k <= 40; ++k) mixed[k].features = shown(0.4, 0.0);
  EXPECT_EQ(trends.add(2, 0.05, mixed[10], mixed), 0);
  OwnRotor rotor = rotor_at(0.2);
  trends.place(rotor);
  EXPECT_NEAR(brought_back(shown(0.11, -1.0), 0, rotor.shifts.data(), 2)[1], 0.125, 1e-9);
}

// On a rotor where a motion causes little vibration, windows of balance agree with both, but balance is nearer.
TEST(FeatureTrends, BalanceIsNotKnownAsAMotionWithLittleVibration) {
  FeatureTrends trends;
  const auto growing = along(0.0, 0.2, 0.0);
  const std::vector<KnownFeatures> known{{.features = growing[20].features, .attractor = 7, .trend = 0}};
  EXPECT_EQ(trends.add(2, 0.05, growing[20], growing), 0);
  ClassificationRule rule;
  rule.window = 1.0;
  rule.boxes = {{.low = known[0].features, .high = known[0].features, .attractor = 7, .hits_needed = 2, .trend = 0}};
  for (int k = 0; k < 3; ++k) {
    rule.boxes[0].low[k] -= 0.004;
    rule.boxes[0].high[k] += 0.004;
  }
  OwnRotor rotor = rotor_at(0.01);
  trends.place(rotor);
  for (const double radius : {0.002, 1e-9}) {
    const int expected = radius > 1e-3 ? 7 : 0;
    EXPECT_EQ(nearest_known(shown(radius, 0.0), known, 2, rotor.shifts.data()) != nullptr, expected == 7) << radius;
    WindowTracker tracker;
    tracker.begin(rule, &rotor);
    WindowSums half{.duration = 0.5, .r2_min = std::pow(0.5 * radius, 2), .r2_max = radius * radius};
    half.r2_integral = std::pow(0.8 * radius, 2) * half.duration;
    for (int k = 0; k < 2; ++k) EXPECT_FALSE(tracker.add(half).decided);
    EXPECT_EQ(tracker.add(half).attractor, expected) << radius;
  }
}

TEST(FeatureTrends, ChaosLastsWhereItDidForAllNearest) {
  FeatureTrends trends;
  std::vector<FeatureTrends::Lasting> tried;
  for (int k = 0; k <= 40; ++k) tried.push_back({{k / 40.0}, k <= 20});
  EXPECT_EQ(trends.add_chaos(tried), 0);
  for (const auto& [x, lasts] : {std::pair{0.1, true}, std::pair{0.9, false}, std::pair{0.51, false}}) {
    OwnRotor rotor = rotor_at(x);
    trends.place(rotor);
    EXPECT_EQ(rotor.chaos_lasts, std::vector<char>{lasts}) << x;
  }
}

}  // namespace feature_trends_test
}  // namespace equipoise
