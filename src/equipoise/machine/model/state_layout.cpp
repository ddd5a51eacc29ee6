// Names, units and frames of a state's variables.
#include "equipoise/machine/model/state_layout.hpp"

#include <fmt/format.h>

namespace equipoise::model {

std::vector<StateVariable> state_variables(const StateLayout& layout) {
  std::vector<StateVariable> v{{"x", "R", "centre O of the shaft, along the rotating x axis"},
                               {"y", "R", "centre O of the shaft, along the rotating y axis"},
                               {"u", "R omega_c", "inertial velocity of O along the rotating x axis"},
                               {"v", "R omega_c", "inertial velocity of O along the rotating y axis"}};
  for (int i = 1; i <= layout.balls; ++i)
    v.push_back({fmt::format("phi_{}", i), "rad", fmt::format("angle of ball {} in the rotating frame", i), true});
  for (int i = 1; i <= layout.balls; ++i)
    v.push_back({fmt::format("phi_dot_{}", i), "omega_c", fmt::format("rate of ball {} in the rotating frame", i)});
  if (layout.psi >= 0) v.push_back({"psi", "rad", "angle of the rotor", true});
  if (layout.speed >= 0) v.push_back({"psi_dot", "omega_c", "speed of the rotor"});
  if (layout.error >= 0)
    v.push_back({"speed_error_integral", "rad", "integral of what the speed lacks of the control's target"});
  if (layout.tilt >= 0) {
    v.push_back({"tilt_x", "rad", "slope of the shaft along the rotating x axis"});
    v.push_back({"tilt_y", "rad", "slope of the shaft along the rotating y axis"});
    v.push_back({"tilt_u", "omega_c", "inertial rate of the slope along the rotating x axis"});
    v.push_back({"tilt_v", "omega_c", "inertial rate of the slope along the rotating y axis"});
  }
  return v;
}

}  // namespace equipoise::model
