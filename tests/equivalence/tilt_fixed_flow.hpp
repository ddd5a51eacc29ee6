// Trajectories, outcomes and eigenvalues of a tilting rotor in fixed axes.
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"
#include "tilt_fixed_axes.hpp"

namespace equipoise::tilting {

inline constexpr const char* long_rotor = R"(
[rotor]
eccentricity = 0.005
eccentricity_angle = 1.0
damping = 0.02
[rotor.tilt]
transverse_inertia = 3.25
polar_inertia = 0.5
misalignment = 0.005
stiffness = [0.0, 9.0]
damping = [0.0, 0.18]
[balancer]
balls = 4
plane = [2, 2, -2, -2]
mass = 0.005
drag = 0.01
[speed]
profile = "constant"
speed = 3.5
[initial]
phi = [1.5707963267948966, -1.5707963267948966, 1.5707963267948966, -1.5707963267948966]
)";

// Integrates in fixed axes: X, Y, SX, SY, theta_i, psi and their rates.
struct FixedFlow {
  const model::Parameters& p;
  bool held;
  double acceleration;                 // prescribed psi''
  double constant = 0.0, slope = 0.0;  // or the motor's torque
  bool driven = false;

  int half() const { return 5 + p.balls; }
  Fixed state(const double* y) const;
  // One body: masses of balls at (mu_i, z_i) turn with the rotor.
  Accelerations as_one(const Fixed& f) const;
  void operator()(double, const double* y, double* dy) const;
};

inline constexpr int most = 2 * (5 + 6);

// False if the integration fails.
bool advance(const FixedFlow& flow, double begin, double end, std::array<double, most>& y, double tolerance = 1e-13);

std::array<double, most> first_state(const Study& s, double speed);

inline Study long_rotor_with(const std::vector<std::string>& overrides = {}) {
  return parse_study(long_rotor, "rotor", overrides);
}

// Damped well, so that motions settle soon.
inline std::vector<std::string> damped(std::vector<std::string> more) {
  for (const char* key : {"rotor.damping=0.2", "rotor.tilt.damping=[0, 1.8]", "balancer.drag=0.3"}) more.push_back(key);
  return more;
}

// dy/dt in turning axes by the equations in fixed axes, at psi = 0.
VectorXd fixed_rate(const model::System& system, const VectorXd& y);

Eigen::VectorXcd fixed_eigenvalues(const model::System& system, const VectorXd& y);

// The furthest that an eigenvalue of `a` is from the nearest one of `b`.
inline double farthest(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  double worst = 0.0;
  for (const Complex& value : a) worst = std::max(worst, (b.array() - value).abs().minCoeff());
  return worst;
}

// Differences have errors of step^2 and of rounding over the step, both near 1e-10; balls that rest nearly alike have
// nearly double eigenvalues, which the root of that moves.
inline constexpr double same_eigenvalue = 2e-5;

// How many balls drift, by a motion's name.
int drifting_by(const std::string& name);

// How many of four balls drift long after the start, followed in fixed axes: at a constant speed, after a ramp from
// rest that holds them, or under a motor with the torque constant + slope psi'. `end`: the state then.
int drifting_in_fixed_axes(const Study& own, double tolerance, std::array<double, most>* end = nullptr);

}  // namespace equipoise::tilting
