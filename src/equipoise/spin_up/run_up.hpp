// A motor brings its rotor to speed, rotor and balls as one body.
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
/// turn with the rotor, which up to model::quiet_speed() shakes at each speed as if it stayed there. Until |psi'| is
/// `to` or the rotor settles below it; without `to` up to the last piece of the motor's law.
SpeedRun rotor_alone(const Study& study, double unbalance, std::optional<double> to);

/// To 95 % of `final_speed`, which a motor only approaches. None if it is there from the beginning.
std::optional<RunUp> run_up(const Study& study, double final_speed);

}  // namespace equipoise
