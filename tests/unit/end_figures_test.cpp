// When figures at the end of a trajectory whose motion is unknown have settled.
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "../support/decided_watch.hpp"
#include "equipoise/results/types/transient_table.hpp"

namespace equipoise {
namespace end_figures_test {

struct Left {
  double time, radius;
};

// A decided trajectory whose centre goes round at speed 1 and the radius r(t): when its figures count as settled.
Left left_at(const std::function<double(double)>& radius) {
  TransientSettings settings;
  DecidedWatch watch(settings);
  const auto sample = [&](double t) {
    TransientSample s;
    const double r = radius(t);
    s.t = t;
    s.places[0].r2 = r * r;
    s.places[0].slope = (std::pow(radius(t + 1e-4), 2) - std::pow(radius(t - 1e-4), 2)) / 2e-4;
    s.places[0].velocity2 = s.places[0].force2 = r * r;
    return s;
  };
  watch.begin(sample(0.0));
  watch.decided({});
  double t = 0.0;
  while (!watch.may_leave() && t < 5e4) watch.step_to(t += 0.5, sample);
  return {t, radius(t)};
}

// A radius right to three digits, or followed for 1024 windows of 16.
TEST(EndFigures, WaitForSlowApproaches) {
  for (const double rate : {1e-2, 3e-3, 1e-3, 3e-4})
    for (const double excess : {0.3, -0.3}) {
      const Left left = left_at([&](double t) { return 1.0 + excess * std::exp(-rate * t); });
      EXPECT_NEAR(left.radius, 1.0, std::max(1e-3, 0.31 * std::exp(-16384.0 * rate))) << rate << " " << excess;
    }
}

// Next to an unstable motion everything looks steady for long.
TEST(EndFigures, WaitForSlowDepartures) {
  const auto away = [](double t) { return 0.02 * std::exp(2e-3 * t); };
  const Left left = left_at([&](double t) { return 1.0 + 0.3 * away(t) / (0.3 + away(t)); });
  EXPECT_NEAR(left.radius, 1.3, 1e-3);
}

TEST(EndFigures, OfSteadyMotionsAreThereSoon) {
  EXPECT_LT(left_at([](double) { return 1.0; }).time, 65.0);
  EXPECT_LT(left_at([](double t) { return 1.0 + 0.2 * std::sin(2.0 * t); }).time, 130.0);
  EXPECT_LT(left_at([](double t) { return 1.0 + std::exp(-0.1 * t); }).time, 260.0);
}

// Windows of chaos never agree.
TEST(EndFigures, OfChaosAreNotWaitedFor) {
  const auto wandering = [](double t) { return 1.0 + 0.3 * std::sin(std::floor(t / 16.0) * std::floor(t / 16.0)); };
  EXPECT_LT(left_at(wandering).time, 1025.0);
}

}  // namespace end_figures_test
}  // namespace equipoise
