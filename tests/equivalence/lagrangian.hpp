// An independent reference for one trajectory: Lagrange's equations in fixed axes, integrated by SUNDIALS.
// Shares only plain data (studies, parameters) with the library; psi(t), equations and integrator are its own.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace lagrangian {

/// psi and its derivatives at one instant.
struct Rotation {
  double angle, rate, acceleration;
};

/// psi(t) from a study's [speed] table, piece by piece: Omega(t) is linear on each and constant on the last;
/// of a Hill function the first piece is the function itself.
class PrescribedRotation {
 public:
  explicit PrescribedRotation(const equipoise::Study& study);

  int branches() const { return static_cast<int>(corners_.size()); }
  double begin_of(int branch) const { return corners_[branch].time; }
  /// Piece in force at and just after `t`.
  int branch_at(double t) const;
  /// The piece's own formula, also at its end, where psi' and psi'' may differ from the next piece's.
  Rotation on_branch(int branch, double t) const;

 private:
  struct Corner {
    double time, speed;  // of the ramp function
    double slope;        // of the ramp function from here on
    double angle;        // the integral of the ramp function from 0 to here
  };
  // Along the Hill function, integrated by quadrature.
  Rotation on_hill(double t) const;

  std::vector<Corner> corners_;
  std::optional<std::array<double, 3>> hill_;  // limit, half time, exponent
  double initial_angle_;
  bool published_;
};

/// Everything in fixed axes; theta_i = psi + phi_i.
struct FixedState {
  double t = 0.0;
  Rotation rotor{};
  double X = 0.0, Y = 0.0, X_dot = 0.0, Y_dot = 0.0;
  std::vector<double> theta, theta_dot;
};

/// A state `z` as in machine/model/parameters.hpp, while the rotor turns like this.
FixedState in_fixed_axes(int balls, const Rotation& rotor, const double* z);

/// Second derivatives, and the torque that the prescribed rotation needs.
struct Accelerations {
  double X, Y, torque;
  std::vector<double> theta;
};

/// From the equations of lagrangian.cpp; `inertia` is iota = I_C/(M R^2).
Accelerations accelerations(const equipoise::model::Parameters& p, double inertia, const FixedState& s, bool clamped);

/// States as vectors, for integrators: X, Y, theta_i, then their derivatives.
void unpack(const double* y, int n, FixedState& s);
/// Derivatives of such a vector `y`, whose state is `s`.
void rates(const equipoise::model::Parameters& p, const FixedState& s, bool clamped, const double* y, double* dy);

/// Kinetic plus potential energy, from their definitions.
double energy(const equipoise::model::Parameters& p, double inertia, const FixedState& s);

/// psi' jumps by `jump`; rotating-frame positions and velocities stay (the published law).
void apply_speed_jump(double jump, FixedState& s);

/// States at `times` (increasing, >= 0) of the study's trajectory with balls held until `release`; at a jump, the state
/// after it. `absolute_tolerance` is per step, for lengths and velocities in units of R and angles in radians.
std::vector<FixedState> integrate(const equipoise::Study& study, double release, const std::vector<double>& times,
                                  double absolute_tolerance = 2e-14);

}  // namespace lagrangian
