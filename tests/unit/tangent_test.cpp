// Tangent vectors: the same bits on every CPU target, and the derivative that differences of trajectories show.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/studies.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {
namespace tangent_test {

const std::string driven = rotor_and_balancer + "[speed]\nprofile = \"torque\"\n";

struct Kind {
  const char* name;
  std::vector<std::string> overrides;
  const std::string& text = constant_speed;
};

class Tangents : public testing::TestWithParam<Kind> {
 protected:
  const Study study_ = parse_study(GetParam().text, "tangents.toml", GetParam().overrides);
  const model::System system_ = study_.system();

  // Away from every symmetry.
  Eigen::VectorXd state() const {
    Eigen::VectorXd z(system_.dimension());
    for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = 0.1 * std::sin(1.0 + 2.0 * static_cast<double>(i));
    for (int i = 0; i < system_.balls(); ++i) z[4 + i] = 0.4 + 1.3 * i;
    if (system_.layout().speed >= 0) z[system_.layout().speed] = 2.2;
    return z;
  }
};

TEST_P(Tangents, AreTheSameOnEveryTarget) {
  const auto here = follow_derivative(system_, state(), 3.0, 1e-10);
  ASSERT_TRUE(here.has_value());
  for (const std::string& target : cpu_targets()) {
    const ChosenCpuTarget chosen(target);
    const auto there = follow_derivative(system_, state(), 3.0, 1e-10);
    ASSERT_TRUE(there.has_value());
    EXPECT_EQ(there->end, here->end) << target;
    EXPECT_EQ(there->tangents, here->tangents) << target;
    // Fewer tangents have their own steps.
    const auto few = follow_tangents(system_, state(), Eigen::MatrixXd::Identity(system_.dimension(), 3), 3.0, 1e-10);
    ASSERT_TRUE(few.has_value());
    EXPECT_LT((few->tangents - here->tangents.leftCols(3)).lpNorm<Eigen::Infinity>(), 1e-6) << target;
  }
}

// Central differences at 1e-5: their error is 1e-10 of third derivatives, and 1e-13 / 1e-5 of the integration.
TEST_P(Tangents, AreTheDerivativeOfTheEnd) {
  constexpr double step = 1e-5, duration = 2.0;
  const auto flight = follow_derivative(system_, state(), duration, 1e-12);
  ASSERT_TRUE(flight.has_value());
  for (Eigen::Index k = 0; k < system_.dimension(); ++k) {
    Eigen::VectorXd ahead = state(), behind = state();
    ahead[k] += step;
    behind[k] -= step;
    const auto a = advance_state(system_, ahead, duration, 0.0, 1e-13),
               b = advance_state(system_, behind, duration, 0.0, 1e-13);
    ASSERT_TRUE(a && b);
    EXPECT_LT(((*a - *b) / (2.0 * step) - flight->tangents.col(k)).lpNorm<Eigen::Infinity>(), 1e-6) << k;
  }
}

const std::vector<std::string> motor{"rotor.inertia=2", "speed.torque={ stall = 0.1, no_load_speed = 3 }"};
const std::vector<std::string> held{
    "rotor.inertia=2",
    "speed.torque={ gain = 0.2, integral = 0.1, limit = 0.5, target = { profile = \"constant\", speed = 2.4 } }"};

INSTANTIATE_TEST_SUITE_P(Of, Tangents,
                         testing::Values(Kind{"plain", {}}, Kind{"one_ball", {"balancer.balls=1"}},
                                         Kind{"three_balls", {"balancer.balls=3"}},
                                         Kind{"gravity", {"rotor.gravity=0.01"}},
                                         Kind{"supports", {"rotor.stiffness=[1.0, 1.3]"}},
                                         Kind{"off_centre", {"balancer.race_offset=[0.02, 0.01]"}},
                                         Kind{"motor", motor, driven}, Kind{"speed_control", held, driven}),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace tangent_test
}  // namespace equipoise
