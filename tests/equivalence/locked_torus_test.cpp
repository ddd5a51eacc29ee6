// A torus of three balls that locks with a period of 1878, in which each ball turns back sixteen times.
#include <cmath>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "../support/parameters.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise {
namespace locked_torus_test {

using Eigen::VectorXd;

model::System rotor() {
  model::Parameters p = base_rotor(3, 0.0687, 0.0389);
  p.eccentricity = 0.0144;
  p.damping = {0.5616, 0.5616};
  return {p, 2.31};
}

VectorXd start(const model::System& system) {
  VectorXd z = VectorXd::Zero(system.dimension());
  z.segment(4, 3) << 0.3, 2.2, 4.4;
  return z;
}

// Period and largest r by an independent integration (Fehlberg's 7(8) at 1e-12, steps of 0.01 at most).
TEST(LockedTorus, ComesBackAfterManyTurns) {
  const model::System system = rotor();
  const auto motion = motion_from(system, start(system));
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->kind, MotionKind::periodic);
  EXPECT_TRUE(motion->stable);
  EXPECT_NEAR(motion->period, 1877.75, 0.01);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(motion->winding[static_cast<std::size_t>(i)], -16);
  EXPECT_NEAR(motion->r_max, 0.03586, 1e-5);
}

// It passes balance now and then.
TEST(LockedTorus, IsNotNearBalance) {
  const model::System system = rotor();
  VectorXd z = start(system);
  std::vector<VectorXd> samples;
  ASSERT_EQ(follow(system, z, 1500.0, 1e-9), IntegrationStatus::done);
  ASSERT_EQ(follow(system, z, 1000.0, 1e-9, nullptr, &samples), IntegrationStatus::done);
  const double near = 0.1 * system.parameters().all_unbalances();
  int passing = 0;
  for (const VectorXd& s : samples) {
    if (s.head(2).norm() > near || std::abs(model::unbalance(system.parameters(), s.data() + 4)) > near) continue;
    if (++passing > 3) break;
    EXPECT_NE(look_at_undecided(system, s).what, Restlessness::near_balance);
  }
  EXPECT_GT(passing, 0);
}

}  // namespace locked_torus_test
}  // namespace equipoise
