// Displacement in windows of time: against single trajectories, and the same whatever the threads.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/one_study/observation.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {
namespace observation_test {

// A ramp whose balls are released before its end, so that psi' jumps while they are free.
Study ramp() {
  Study study = read_study(std::string(EQUIPOISE_SOURCE_DIR) + "/studies/paper/table-5-t0-100.toml");
  study.sampling.seed = 7;
  return study;
}

ObservationSettings settings(std::uint64_t starts, int threads) {
  ObservationSettings s;
  s.starts = starts;
  s.window = 5.0;
  s.until = 180.0;
  s.threads = threads;
  return s;
}

// Largest and last r^2 of one start in window k, sampled 500 times a unit of time.
std::pair<double, double> sampled(const Trajectory& one, double begin, double end) {
  double largest = 0.0, last = 0.0;
  for (std::size_t j = 0; j < one.t.size(); ++j) {
    if (one.t[j] < begin - 1e-9 || one.t[j] > end + 1e-9) continue;
    last = one.radial[j] * one.radial[j];
    largest = std::max(largest, last);
  }
  return {largest, last};
}

TEST(Observation, AgreesWithSingleTrajectories) {
  Study study = ramp();
  const double release = study.release_time();
  const Observation seen = observe(study, settings(6, 2));
  ASSERT_TRUE(seen.complete);
  ASSERT_EQ(seen.windows, 36u);
  std::vector<double> times;
  for (int j = static_cast<int>(std::ceil(release * 500.0)); j <= 180 * 500; ++j) times.push_back(j / 500.0);
  for (std::size_t i = 0; i < seen.starts; ++i) {
    start_angles(study.sampling.seed, i, 2, study.initial.phi.data());
    const Trajectory one = simulate(study, times);
    for (std::size_t k = 0; k < seen.windows; ++k) {
      const float largest = seen.largest[i * seen.windows + k], last = seen.at_end[i * seen.windows + k];
      if (seen.end_of(k) <= release) {
        EXPECT_TRUE(std::isnan(largest) && std::isnan(last));
        continue;
      }
      const auto [expected, expected_last] = sampled(one, seen.end_of(k) - seen.window, seen.end_of(k));
      // The cubic's error in r^2 is below 1 % of the largest value nearby. So soon after the release, trajectories of
      // tolerance 1e-6 differ from those of 1e-12 by less than that.
      EXPECT_NEAR(largest, expected, 0.01 * expected) << "start " << i << ", window " << k;
      EXPECT_NEAR(last, expected_last, 0.01 * expected) << "start " << i << ", window " << k;
    }
  }
}

TEST(Observation, SameBitsForOneThreadAndTwoAndHoweverCut) {
  const Study study = ramp();
  const Observation one = observe(study, settings(2500, 1)), two = observe(study, settings(2500, 2));
  const auto same = [](float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  EXPECT_TRUE(std::equal(one.largest.begin(), one.largest.end(), two.largest.begin(), two.largest.end(), same));
  EXPECT_TRUE(std::equal(one.at_end.begin(), one.at_end.end(), two.at_end.begin(), two.at_end.end(), same));
  ObservationSettings later = settings(100, 2);
  later.first = 1100;
  const Observation part = observe(study, later);
  EXPECT_TRUE(std::equal(part.largest.begin(), part.largest.end(),
                         one.largest.begin() + static_cast<std::ptrdiff_t>(1100 * one.windows), same));
}

TEST(Observation, RejectsWhatCannotBeObserved) {
  ObservationSettings s = settings(10, 1);
  s.window = 0.0;
  EXPECT_THROW(observe(ramp(), s), InputError);
  s = settings(0, 1);
  EXPECT_THROW(observe(ramp(), s), InputError);
  s = settings(10, 1);
  s.until = 1.0;
  EXPECT_THROW(observe(ramp(), s), InputError);
}

}  // namespace observation_test
}  // namespace equipoise
