// Three slow balls and a captured one: 3 000 quiet time units, one burst, and again. Deviations grow by e^15 in a burst
// and fade as much before it, so there is no chaos, although 1 500 units with a burst look like it.
#include <Eigen/Core>
#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {
namespace bursts_test {

model::System rotor() {
  model::Parameters p = base_rotor(4);
  p.eccentricity = 0.0171;
  p.damping = {0.6274, 0.6274};
  const double mass[] = {0.0572, 0.0303, 0.0501, 0.0284}, drag[] = {0.136, 0.137, 0.1118, 0.0342};
  for (int i = 0; i < 4; ++i) {
    p.mass[i] = mass[i];
    p.drag[i] = drag[i];
  }
  return {p, 2.255};
}

// A state after 40 000 time units of an independent integration (DOP853 at 1e-10).
TEST(Bursts, AreNotTakenForChaos) {
  const model::System system = rotor();
  Eigen::VectorXd z(12);
  z << -0.0466161, -0.00258339, -0.00408457, 0.0553672, 1.03201, 4.87978, 3.52552, 4.85609, -0.0343842, 0.0222824,
      0.0213347, -1.27559;
  int bursts = 0, like_chaos = 0;
  for (int window = 0; window < 12; ++window) {
    if (const auto exponents = lyapunov_exponents(system, z, 1500.0, 1); exponents.front() > 8.0 / 1500.0) {
      ++like_chaos;
      EXPECT_NE(look_at_undecided(system, z).what, Restlessness::chaotic);
    }
    MotionStatistics statistics;
    ASSERT_EQ(follow(system, z, 500.0, 1e-9, &statistics), IntegrationStatus::done);
    bursts += statistics.r_max > 0.0495;
  }
  EXPECT_GT(bursts, 1);
  EXPECT_LT(bursts, 5);
  EXPECT_GT(like_chaos, 1);
}

}  // namespace bursts_test
}  // namespace equipoise
