// A tilting rotor by Lagrange's equations in fixed axes with their full mass matrix, independent of the library's
// equations.
#pragma once

#include <array>
#include <complex>

#include <Eigen/Core>

#include "equipoise/machine/model/system.hpp"

namespace equipoise::tilting {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;
inline constexpr Complex i1(0.0, 1.0);

inline constexpr int most_accelerations = 5 + model::max_balls;
using OfBalls = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, model::max_balls, 1>;
using Accelerations = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_accelerations, 1>;

// Fixed axes: centre and slope as complex numbers, absolute ball angles, psi.
struct Fixed {
  Complex q1, q2, v1, v2;
  OfBalls theta, rate;
  double psi = 0.0, w = 0.0;
};

Fixed fixed_of(const model::Parameters& p, const model::System& system, const VectorXd& y, double psi, double w);

// Generalised forces: springs and dampers on centre and slope.
std::array<Complex, 2> supports(const model::Parameters& p, const Fixed& f);

// Accelerations of (X, Y, SX, SY, theta_1.., psi) from M a = F. `torque`: on the rotor; psi'' = `given` without one.
Accelerations accelerations(const model::Parameters& p, const Fixed& f, const double* torque, double given);

}  // namespace equipoise::tilting
