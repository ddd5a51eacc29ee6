// Lanes of smooth systems (motors, off-centre races, with gravity and unequal supports) against the same starts one by
// one in doubles, from event to event: spin-up, release, pieces of the drive, the last piece.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "lane_studies.hpp"

namespace smooth_batch_test {

using namespace lanes;

constexpr double until = 60.0;

struct Case {
  std::string name, toml;
  double accuracy = 1e-6;  // lanes err by up to 1e-10 per step; near resonance errors grow by a thousand on the way
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

std::string torque(const std::string& law) {
  return "[speed]\nprofile = \"torque\"\ninitial = 0.5\ntorque = " + law + "\n";
}
const std::string linear = "{ constant = 0.6, slope = -0.2 }";

std::vector<Case> cases() {
  return {{"motor", rotor("") + balls(2) + torque(linear)},
          {"motor_one_ball", rotor("") + balls(1) + torque(linear)},
          {"motor_with_gravity", rotor(upright) + balls(3) + torque(linear)},
          {"motor_releasing_at_a_speed", rotor("") + balls(2) + torque(linear) + at_speed},
          {"off_centre_motor_with_gravity_releasing_at_a_speed",
           rotor(upright) + balls(4, off_centre) + torque(linear) + at_speed},
          // Corners of the curve may lie anywhere in a step: 4e-6 was seen.
          {"motor_by_its_curve_with_a_fan",
           rotor(upright) + balls(3) +
               torque("{ speeds = [0.0, 1.2, 2.0, 2.2], values = [0.3, 0.5, 0.4, 0.0] }\n"
                      "load = { constant = 0.02, linear = 0.03, quadratic = 0.1, at = 2.0 }"),
           2e-5},
          {"motor_switched_off", rotor("") + balls(2) + torque("{ constant = 0.3, slope = -0.1, until = 30.0 }")},
          {"table_releasing_at_a_time",
           rotor("") + balls(3) + torque("{ times = [2.0, 20.0, 30.0], values = [0.4, 0.2, -0.1] }") + at_time},
          // A corner of the torque may lie anywhere in a step: there lanes and doubles err differently, by its size.
          {"control_with_integral_and_limit_of_five_balls",
           rotor(upright) + balls(5) +
               torque("{ gain = 2.0, integral = 0.5, limit = 0.5, target = { profile = \"ramp\", initial = 1.0, final "
                      "= 2.5, duration = 10.0 } }") +
               at_speed,
           1e-4},
          {"off_centre", rotor("") + balls(2, off_centre) + ramp},
          {"off_centre_with_gravity", rotor(upright) + balls(3, off_centre) + ramp + at_time},
          {"off_centre_released_late_of_six", rotor(upright) + balls(6, off_centre) + ramp}};
}

class SmoothLanes : public testing::TestWithParam<Case> {};

TEST_P(SmoothLanes, FollowStartsAsDoublesDo) {
  const Study study = parse_study(GetParam().toml, "study");
  const model::System system = study.system();
  const auto source = make_spin_up(study, nullptr);
  SpunUp spun;
  ASSERT_TRUE(source->make(study.sampling.seed, 0, starts, spun));
  BatchTask task = source->last_task();
  task.end = until;
  task.count = starts;
  task.states = spun.states.data();
  if (!spun.begins.empty()) task.begins = spun.begins.data();
  std::vector<Outcome> outcomes(starts);
  ASSERT_TRUE(advance_batch(task, outcomes));
  const auto size = static_cast<std::size_t>(system.dimension());
  ASSERT_EQ(spun.states.size(), starts * size);
  const Eigen::VectorXd scale = system.scale();
  for (std::size_t i = 0; i < starts; ++i) {
    ASSERT_EQ(outcomes[i].kind, OutcomeKind::undecided);
    ASSERT_FALSE(spun.is_over(i));
    const Reference reference = one_by_one(study, i, until);
    for (std::size_t k = 0; k < size; ++k)
      EXPECT_NEAR(spun.states[i * size + k], reference.state[k], GetParam().accuracy * scale[k]) << i << " " << k;
    // Release times carry the errors of the way there, divided by psi'' of the order of 0.1.
    const double released = spun.released.empty() ? reference.released : spun.released[i];
    EXPECT_NEAR(released, reference.released, 1e-7) << i;
  }
}
INSTANTIATE_TEST_SUITE_P(AllSystems, SmoothLanes, testing::ValuesIn(cases()),
                         [](const auto& info) { return info.param.name; });

// Place, neighbours and number of a trajectory do not change its bits.
TEST(SmoothLanesAlone, GiveTheSameBits) {
  const Study study = parse_study(cases()[4].toml, "study");
  const auto source = make_spin_up(study, nullptr);
  const auto size = static_cast<std::size_t>(study.system().dimension());
  const auto run = [&](std::uint64_t first, std::size_t count) {
    SpunUp spun;
    EXPECT_TRUE(source->make(study.sampling.seed, first, count, spun));
    BatchTask task = source->last_task();
    task.end = until;
    task.count = count;
    task.states = spun.states.data();
    task.begins = spun.begins.data();
    std::vector<Outcome> outcomes(count);
    EXPECT_TRUE(advance_batch(task, outcomes));
    return spun.states;
  };
  const std::vector<double> together = run(0, starts);
  for (const std::uint64_t i : {0u, 7u, 18u}) {
    const std::vector<double> alone = run(i, 1);
    for (std::size_t k = 0; k < size; ++k) EXPECT_EQ(alone[k], together[i * size + k]);
  }
}

// A motor too weak to bring the rotor to the speed of release: its balls stay held, and its outcome is decided.
TEST(HeldBalls, OfAMotorThatIsTooWeakAreNeverLetGo) {
  const Study study =
      parse_study(rotor("") + balls(2) + "[release]\nspeed = 2.5\n" + torque("{ stall = 0.02, no_load_speed = 2.0 }"),
                  "study", {"numerics.horizon=60000", "numerics.tolerance=1e-6"});
  SpunUp spun;
  ASSERT_TRUE(make_spin_up(study, nullptr)->make(1, 0, 8, spun));
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_TRUE(spun.is_over(i));
    // Vibration takes torque, and the motor has none at its no-load speed.
    EXPECT_LT(spun.outcomes[i].mean_speed, 2.0);
    EXPECT_LT(spun.outcomes[i].time, 60000.0) << "decided before the horizon";
    EXPECT_LT(spun.nearest[i], 2.0);
    const double stall = study.stall_speed();
    EXPECT_EQ(spun.outcomes[i].kind,
              spun.outcomes[i].mean_speed < stall ? OutcomeKind::stalled : OutcomeKind::undecided);
  }
}

}  // namespace smooth_batch_test
