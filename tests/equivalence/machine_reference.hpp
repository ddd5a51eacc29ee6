// An independent reference for machines: mass points and their Jacobians in fixed axes, events by halving steps.
// Shares only plain data (studies, parameters) with the library; equations, torque, events and integrator are its own.
#pragma once

#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace machine_reference {

/// Fixed axes; the ball angles theta_i = psi + phi_i.
struct State {
  double t = 0.0;
  double X = 0.0, Y = 0.0, psi = 0.0, X_dot = 0.0, Y_dot = 0.0, psi_dot = 0.0;
  double error_integral = 0.0;  ///< of a speed control
  std::vector<double> theta, theta_dot;
  double energy = 0.0;    ///< kinetic and potential
  double work = 0.0;      ///< done by the motor since t = 0
  double supports = 0.0;  ///< dissipated by the supports' dampers since then
  double balls = 0.0;     ///< dissipated by drag and rolling resistance
  double impacts = 0.0;   ///< dissipated by impacts
};

/// States at `times` (increasing) of a driven study, or of one at constant speed (then psi'' = 0 is imposed). Classical
/// Runge-Kutta with steps of at most `step`, cut at every time, release, impact, start and stop of a ball.
std::vector<State> integrate(const equipoise::Study& study, const std::vector<double>& times, double step);

}  // namespace machine_reference
