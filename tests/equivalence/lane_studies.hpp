// Studies for tests of lanes, and the same starts one by one in doubles, from event to event.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace lanes {

using namespace equipoise;
using Machine = HWY_NAMESPACE::EventTrajectory<model::any_count>;

constexpr std::size_t starts = 19;  // more than two groups of lanes, and no multiple of their number

inline std::string rotor(const std::string& more = "") {
  return "[rotor]\neccentricity = 0.02\ndamping = 0.4\ninertia = 4.0\n" + more +
         "[numerics]\ntolerance = 1e-10\nhorizon = 100\n";
}
inline std::string balls(int n, const std::string& more = "") {
  return "[balancer]\nballs = " + std::to_string(n) + "\nmass = 0.03\ndrag = 0.2\n" + more;
}
inline const std::string upright = "gravity = 0.02\nstiffness = [1.0, 1.3]\n",
                         ramp = "[speed]\nprofile = \"ramp\"\nfinal = 2.4\nduration = 20.0\n",
                         off_centre = "race_offset = [0.03, -0.02]\n", at_speed = "[release]\nspeed = 0.9\n",
                         at_time = "[release]\ntime = 7.3\n";

inline Machine::Scale tight(const model::Parameters& p) {
  Machine::Scale scale;
  scale.tolerance = 1e-13;
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = p.all_unbalances();
  scale.absolute.fill(true);
  scale.angle.fill(true);
  return scale;
}

struct Reference {
  std::vector<double> state;  // of the system
  double released = 0.0;
  long events = 0;  // without the release
};

inline Reference one_by_one(const Study& study, std::uint64_t index, double until) {
  const model::Parameters& p = study.parameters;
  const model::Drive drive = study.drive();
  double z[Machine::dimension];
  initial_state(start_of(study, study.sampling.seed, index), p.balls, drive.speed, z);
  Machine machine(p, drive, tight(p), z);
  const bool held = machine.clamped();
  EXPECT_EQ(machine.advance(until, [](auto&&...) { return false; }), IntegrationStatus::done);
  const double* end = machine.state();
  const model::StateLayout layout = study.system().layout();
  std::vector<double> state(static_cast<std::size_t>(layout.size));
  model::copy_state(model::machine_layout(p.balls), end, layout, state.data());
  return {state, machine.released(), machine.events() - held};
}

}  // namespace lanes
