// A motor bringing its rotor to speed, the rotor and its balls as one body.
#pragma once

#include <optional>

#include "equipoise/results/explanation.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Where a run of the speed alone ends.
struct SpeedRun {
  double time = 0.0, speed = 0.0;
  bool arrived = false;  ///< at the speed asked for
};

/// (I_C + M eps^2 + N) psi'' = tau less model::shaking_torque() of `unbalance`, from rest or the initial speed: balls
/// turn with the rotor, and up to model::quiet_speed(), from where balls cancel what they can, the rotor shakes at each
/// speed as it would if it stayed there. Until |psi'| is `to`, or to
/// where the rotor comes to rest at less; without `to` up to the last piece of the motor's law.
SpeedRun rotor_alone(const Study& study, double unbalance, std::optional<double> to);

/// Of a motor, to 95 % of `final_speed`: it comes closer for ever. None if it is there from the beginning.
std::optional<RunUp> run_up(const Study& study, double final_speed);

}  // namespace equipoise
