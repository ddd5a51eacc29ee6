// A rotor that tilts by Lagrange's equations in fixed axes with their full mass matrix, independent of the library's
// equations.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>

#include "equipoise/model/system.hpp"

namespace equipoise::tilting {

using Complex = std::complex<double>;
using Eigen::MatrixXd;
using Eigen::VectorXd;
inline constexpr Complex i1(0.0, 1.0);

// Fixed axes: centre and slope as complex numbers, absolute ball angles, psi.
struct Fixed {
  Complex q1, q2, v1, v2;
  std::vector<double> theta, rate;
  double psi = 0.0, w = 0.0;
};

inline Fixed fixed_of(const model::Parameters& p, const model::System& system, const VectorXd& y, double psi,
                      double w) {
  Fixed f;
  f.psi = psi;
  f.w = w;
  const Complex turn = std::polar(1.0, psi);
  const int t = system.layout().tilt;
  f.q1 = Complex(y[0], y[1]) * turn;
  f.v1 = Complex(y[2], y[3]) * turn;
  f.q2 = Complex(y[t], y[t + 1]) * turn;
  f.v2 = Complex(y[t + 2], y[t + 3]) * turn;
  for (int i = 0; i < p.balls; ++i) {
    f.theta.push_back(psi + y[4 + i]);
    f.rate.push_back(w + y[4 + p.balls + i]);
  }
  return f;
}

inline Complex axis_wise(double x, double y, Complex v) { return {x * v.real(), y * v.imag()}; }

// Generalised forces: springs and dampers on centre and slope.
inline std::array<Complex, 2> supports(const model::Parameters& p, const Fixed& f) {
  const auto& k = p.tilt.stiffness;
  const auto& c = p.tilt.damping;
  return {axis_wise(p.stiffness[0], p.stiffness[1], f.q1) + axis_wise(k[0][0], k[1][0], f.q2) +
              axis_wise(p.damping[0], p.damping[1], f.v1) + axis_wise(c[0][0], c[1][0], f.v2),
          axis_wise(k[0][0], k[1][0], f.q1) + axis_wise(k[0][1], k[1][1], f.q2) + axis_wise(c[0][0], c[1][0], f.v1) +
              axis_wise(c[0][1], c[1][1], f.v2)};
}

// Accelerations of (X, Y, SX, SY, theta_1.., psi) from M a = F. `torque`: on the rotor; psi'' = `given` without one.
inline VectorXd accelerations(const model::Parameters& p, const Fixed& f, const double* torque, double given) {
  const int n = p.balls, size = 5 + n;
  MatrixXd m = MatrixXd::Zero(size, size);
  VectorXd force = VectorXd::Zero(size);
  const double w = f.w, couple = p.tilt.misalignment * (p.tilt.transverse_inertia - p.tilt.polar_inertia);
  const auto put = [&](int row, Complex v) {
    force[row] += v.real();
    force[row + 1] += v.imag();
  };
  m.topLeftCorner(2, 2).setIdentity();
  m.block(2, 2, 2, 2) = p.tilt.transverse_inertia * MatrixXd::Identity(2, 2);
  const auto link = [&](int row, int column, Complex v) {
    m(row, column) += v.real();
    m(row + 1, column) += v.imag();
    m(column, row) += v.real();
    m(column, row + 1) += v.imag();
  };
  const Complex unbalance = std::polar(p.eccentricity, f.psi + p.eccentricity_angle),
                across = couple * std::polar(1.0, f.psi);
  link(0, size - 1, i1 * unbalance);
  link(2, size - 1, i1 * across);
  m(size - 1, size - 1) = p.inertia + p.eccentricity * p.eccentricity;
  put(0, w * w * unbalance - i1 * p.gravity);
  put(2, w * w * across + i1 * w * p.tilt.polar_inertia * f.v2);
  force[size - 1] -= p.gravity * unbalance.real();
  for (int i = 0; i < n; ++i) {
    const double mu = p.mass[i], z = p.tilt.plane[i];
    const Complex e = std::polar(1.0, f.theta[i]);
    for (int k = 0; k < 2; ++k) {
      m(k, k) += mu;
      m(2 + k, 2 + k) += mu * z * z;
      m(k, 2 + k) += mu * z;
      m(2 + k, k) += mu * z;
    }
    link(0, 4 + i, mu * i1 * e);
    link(2, 4 + i, mu * z * i1 * e);
    m(4 + i, 4 + i) = mu;
    const Complex pull = mu * (f.rate[i] * f.rate[i] * e - i1 * p.gravity);
    put(0, pull);
    put(2, z * pull);
    const double drag = mu * p.drag[i] * (f.rate[i] - w);
    force[4 + i] -= drag + mu * p.gravity * e.real();
    force[size - 1] += drag;
  }
  const auto s = supports(p, f);
  put(0, -s[0]);
  put(2, -s[1]);
  if (torque) {
    force[size - 1] += *torque;
  } else {
    m.row(size - 1).setZero();
    m(size - 1, size - 1) = 1.0;
    force[size - 1] = given;
  }
  return m.partialPivLu().solve(force);
}

}  // namespace equipoise::tilting
