// Mean rates of angles: slow drifts of regular motion are detected, slips of chaos are judged by their scatter.
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/core/base/angles.hpp"

namespace equipoise {
namespace mean_rate_test {

AngleRecord record_of(double duration, double spacing, const std::function<double(double)>& angle) {
  AngleRecord record(spacing);
  for (long k = 0; static_cast<double>(k) * spacing <= duration; ++k)
    record.add(angle(static_cast<double>(k) * spacing));
  return record;
}

// Two incommensurate swings of half a radian each, as on a torus.
double swing(double t) { return 0.5 * std::sin(0.731 * t) + 0.5 * std::cos(2.0 * std::sqrt(3.0) * t + 1.0); }

TEST(MeanRate, SeesADriftOfATorusThatIsFarBelowATurn) {
  for (const double drift : {0.0378, -1e-3, 3e-5, -1e-6}) {
    const MeanRate mean = mean_rate(record_of(8000.0, 0.4, [&](double t) { return drift * t + swing(t); }), true);
    // Weights that fall like exp(-1/s) reduce swings of 900 periods and more to below 1e-9.
    EXPECT_NEAR(mean.rate, drift, 1e-9) << drift;
    EXPECT_EQ(drift_of(mean, true, 0.01), Drift::some) << drift;
  }
}

TEST(MeanRate, CallsASwingingBallCaptured) {
  for (const double phase : {0.0, 0.7, 2.9}) {
    const MeanRate mean = mean_rate(record_of(4000.0, 0.4, [&](double t) { return 3.0 + swing(t + phase); }), true);
    EXPECT_NEAR(mean.rate, 0.0, 1e-9);
    EXPECT_EQ(drift_of(mean, true, 0.01), Drift::none);
  }
}

// One turn every 3000 units of time, at rest in between: halves differ by as much as the drift, yet it slips only one
// way.
TEST(MeanRate, SeesRareSlipsOfRegularMotion) {
  const auto slips = [](double t) { return two_pi * std::floor(t / 3000.0 + 0.5) + 0.3 * std::sin(t); };
  EXPECT_EQ(drift_of(mean_rate(record_of(5000.0, 0.4, slips), true), true, 0.01), Drift::some);
}

// Slips at random, on average one in `every` units of time, forwards with the probability `forwards`.
AngleRecord random_slips(unsigned seed, double duration, double every, double forwards) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  AngleRecord record(1.0);
  double angle = 0.0;
  for (double t = 0.0; t < duration; t += 1.0) {
    if (uniform(random) < 1.0 / every) angle += uniform(random) < forwards ? two_pi : -two_pi;
    record.add(angle + 0.2 * uniform(random));
  }
  return record;
}

TEST(MeanRate, WeighsSlipsOfChaosAgainstTheirScatter) {
  std::size_t captured = 0, too_soon = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    // 200 slips in 2e4: a standard deviation of 2 pi sqrt(200) / 2e4 = 0.0044, three of them below 0.024.
    const MeanRate none = mean_rate(random_slips(seed, 2e4, 100.0, 0.5), false);
    captured += drift_of(none, false, 0.024) == Drift::none;
    EXPECT_NEAR(none.error, 3.0 * 0.0044, 0.0075) << seed;  // sixteen blocks know it to 18 %; three times that is
                                                            // allowed
    // Three of four forwards: a drift of 0.031, seven standard deviations.
    EXPECT_EQ(drift_of(mean_rate(random_slips(seed, 2e4, 100.0, 0.75), false), false, 0.024), Drift::some) << seed;
    // A tenth of the time is not enough.
    too_soon += drift_of(mean_rate(random_slips(seed, 2e3, 100.0, 0.5), false), false, 0.024) == Drift::none;
  }
  EXPECT_LE(too_soon, 2u);   // three standard deviations are 0.042 there, which blocks know to 18 %
  EXPECT_GE(captured, 38u);  // three standard deviations by Student's t with 15 degrees are exceeded by 1 in 110
}

// Two balls in chaos whose angles differ by a walk of two radians in all: significant, but it may come back, and a
// drift of less than a hundredth of the speed does not matter.
TEST(MeanRate, AWanderWithinATurnIsNoDriftOfChaos) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 0.03);
    const MeanRate mean = mean_rate(record_of(5000.0, 1.0, [&](double t) { return 4e-4 * t + noise(random); }), false);
    EXPECT_GT(std::fabs(mean.rate), mean.error);
    EXPECT_EQ(drift_of(mean, false, 0.024), Drift::none) << seed;
  }
}

// The two balls of a torus at eccentricity 0.006776 over 2000 units (table 2, speed 2.4): parts agreed by chance, the
// rate fell to zero over longer times. So did a rate of 1.28e-6 over 2500 units (table 3, run-up in 100, eccentricity
// 0.011586, drag 0.04723), eleven times its error.
TEST(MeanRate, ARateOfRegularMotionNearItsErrorIsMeasuredForLonger) {
  MeanRate mean{.rate = 2.24e-6, .error = 8.5e-7, .duration = 2000.0, .turned = 2.72};
  EXPECT_EQ(drift_of(mean, true, 0.024), Drift::unknown);
  mean.error = 1e-7;
  EXPECT_EQ(drift_of(mean, true, 0.024), Drift::unknown);
  mean.duration = 8000.0;
  EXPECT_EQ(drift_of(mean, true, 0.024), Drift::some);
  mean.error = 7e-6;
  EXPECT_EQ(drift_of(mean, true, 0.024), Drift::none);
}

TEST(MeanRate, RecordsOfAnyLengthStayBoundedAndExact) {
  const AngleRecord record = record_of(2e5, 0.4, [](double t) { return 0.01 * t + swing(t); });
  EXPECT_LE(record.size(), (std::size_t{1} << 16) + 1);
  EXPECT_GE(record.size(), std::size_t{1} << 15);
  EXPECT_NEAR(record.duration(), 2e5, record.spacing());
  EXPECT_NEAR(mean_rate(record, true).rate, 0.01, 1e-9);
  EXPECT_EQ(mean_rate(record - record, true).rate, 0.0);
}

}  // namespace mean_rate_test
}  // namespace equipoise
