// Tilting rotors under a motor: outcomes and transients are those of trajectories in fixed axes.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/study/sampling/starts.hpp"
#include "tilt_dense.hpp"
#include "transient_lanes.hpp"

namespace equipoise {
namespace tilt_motor_test {

using namespace tilting;

std::vector<std::string> under_motor(std::vector<std::string> more) {
  more.push_back("speed={ profile = \"torque\", initial = 2.0, torque = { constant = 0.7, slope = -0.2 } }");
  more.push_back("rotor.tilt.bearings_at=[3, -3]");
  return damped(std::move(more));
}

TEST(TiltMotor, TransientsAreThoseOfFixedAxes) {
  const std::vector<StatedBearing> bearings{{3.0, {0.5, 0.5}, {0.1, 0.1}}, {-3.0, {0.5, 0.5}, {0.1, 0.1}}};
  for (const char* gravity : {"rotor.gravity=0", "rotor.gravity=0.01"}) {
    Study study = with_horizon(long_rotor_with(under_motor({gravity})));
    study.limits.displacement = 0.03;
    study.limits.settled = 0.01;
    TransientSettings asked = transient_settings(study);
    ASSERT_FALSE(asked.shaft.bearings.empty());
    ASSERT_EQ(asked.work, WorkSource::motor);
    asked.window = 1e6;
    constexpr double until = 60.0;
    constexpr std::size_t count = 4;
    const auto source = make_spin_up(study, nullptr);
    source->watch(asked);
    TransientTable table{asked, {}, {}};
    SpunUp starts;
    ASSERT_TRUE(source->make(study.sampling.seed, 0, count, starts, &table));
    BatchTask task = source->last_task();
    task.states = starts.states.data();
    task.count = count;
    task.begins = starts.begins.data();
    task.end = until;
    task.transients = &table;
    ClassificationRule rule;
    rule.balls = study.parameters.balls;
    rule.at_horizon = true;
    ASSERT_TRUE(classify_batch(task, rule, starts.outcomes, nullptr));
    for (std::size_t i = 0; i < count; ++i) {
      start_angles(study.sampling.seed, i, study.parameters.balls, study.initial.phi.data());
      const TransientRow expected =
          figures(asked, tilting::dense(study, stretches(study, until), {3.0, -3.0}, bearings), 0.0);
      const TransientRow told = transient_row(asked, table.rows[i], false);
      const std::string what = std::string(gravity) + ", start " + std::to_string(i);
      expect_same_figures(told, expected, what, 0.0, asked.by_direction);
      EXPECT_NEAR(told.energy, expected.energy, 5e-4f * expected.energy) << what;
    }
  }
}

// A motor from rest that reaches its speed in a few turns, and balls that lag behind it.
TEST(TiltMotor, OutcomesAreThoseOfFixedAxes) {
  const Study s =
      long_rotor_with({"rotor.damping=0.1", "rotor.tilt.damping=[0, 0.9]", "balancer.drag=0.05", "balancer.mass=0.0025",
                       "initial.phi_dot=-1.5", "numerics.tolerance=1e-11", "sampling.starts=6",
                       "speed={ profile = \"torque\", initial = 3.0, torque = { constant = 0.7, slope = "
                       "-0.2 } }"});
  std::vector<Outcome> outcomes;
  BasinOptions options;
  options.transients = true;
  options.outcome = [&](const Outcome& outcome) { outcomes.push_back(outcome); };
  Catalogue catalogue;
  const BasinResult result = basin(s, options, &catalogue);
  ASSERT_EQ(outcomes.size(), s.sampling.starts);
  ASSERT_TRUE(result.transients);
  EXPECT_EQ(result.transients->lost, 0u);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Attractor* attractor = catalogue.find(outcomes[i].attractor);
    ASSERT_TRUE(attractor) << i;
    Study own = s;
    own.initial = start_of(s, i);
    EXPECT_EQ(drifting_in_fixed_axes(own, 1e-11), drifting_by(attractor->name)) << i << ", " << attractor->name;
  }
}

}  // namespace tilt_motor_test
}  // namespace equipoise
