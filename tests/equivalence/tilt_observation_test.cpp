// Observed displacements of tilting rotors: those of trajectories in fixed axes at the bearing that is further out.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "equipoise/analyses/one_study/observation.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/sampling/starts.hpp"
#include "tilt_dense.hpp"

namespace equipoise {
namespace tilt_observation_test {

using namespace tilting;

TEST(TiltObservation, IsThatOfFixedAxes) {
  const std::string ramp = "speed={ profile = \"ramp\", initial = 0.0, final = 3.5, duration = 20 }";
  for (const auto& [at, places] :
       {std::pair<std::string, std::vector<double>>{"rotor.tilt.bearings_at=[2.5, -1.5]", {2.5, -1.5}},
        {"rotor.eccentricity_angle=1", {0.0}}}) {
    Study study = long_rotor_with(damped({at, ramp, "release.speed=2.5", "numerics.tolerance=1e-9"}));
    ObservationSettings settings;
    settings.starts = 3;
    settings.window = 5.0;
    settings.until = 60.0;
    const Observation seen = observe(study, settings);
    ASSERT_TRUE(seen.complete);
    ASSERT_EQ(seen.windows, 12u);
    for (std::size_t i = 0; i < seen.starts; ++i) {
      start_angles(study.sampling.seed, i, study.parameters.balls, study.initial.phi.data());
      const std::vector<Seen> all = tilting::dense(study, stretches(study, settings.until), places);
      for (std::size_t k = 3; k < seen.windows; ++k) {  // the balls are free from 14.3 on
        double largest = 0.0, last = 0.0;
        for (const Seen& s : all) {
          if (s.t < seen.end_of(k) - settings.window - 1e-9 || s.t > seen.end_of(k) + 1e-9) continue;
          last = s.radial * s.radial;
          largest = std::max(largest, last);
        }
        EXPECT_NEAR(seen.largest[i * seen.windows + k], largest, 0.01 * largest) << i << " " << k;
        EXPECT_NEAR(seen.at_end[i * seen.windows + k], last, 0.01 * largest) << i << " " << k;
      }
    }
  }
}

TEST(TiltObservation, StillNeedsEqualSupports) {
  ObservationSettings settings;
  EXPECT_THROW(observe(long_rotor_with({"rotor.tilt.stiffness={ x = [0, 9], y = [0, 10] }"}), settings), InputError);
}

}  // namespace tilt_observation_test
}  // namespace equipoise
