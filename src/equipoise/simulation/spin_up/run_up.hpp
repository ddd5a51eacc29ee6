// How a motor brings its rotor to speed, with rotor and balls as one body.
#pragma once

#include <optional>

#include "equipoise/results/commands/explanation.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Where a run of the speed alone ends.
struct SpeedRun {
  double time = 0.0, speed = 0.0;
  bool arrived = false;  ///< at the requested speed
};

/// Solves (I_C + M eps^2 + N) psi'' = tau less model::shaking_torque() of `unbalance`, from rest or the initial speed.
/// Balls turn with the rotor. Up to model::quiet_speed() the rotor vibrates at each speed as if it stayed there. Ends
/// when |psi'| is `to` or the rotor stays below it; without `to` at the last piece of the drive.
SpeedRun rotor_alone(const Study& study, double unbalance, std::optional<double> to);

/// The run-up to 95 % of `final_speed`, which a motor only approaches. None if the rotor is there from the beginning.
std::optional<RunUp> run_up(const Study& study, double final_speed);

}  // namespace equipoise
