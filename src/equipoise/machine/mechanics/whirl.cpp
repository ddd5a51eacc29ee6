// Stiffness and inertia of centre and slope.
#include "equipoise/machine/mechanics/whirl.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "equipoise/core/math/dense.hpp"

namespace equipoise::model {

namespace {

using Matrix4 = Eigen::Matrix4d;

// Of supports or inertia, for X, Y and the slopes along them.
Matrix4 of_centre_and_tilt(const std::array<double, 2>& of_centre,
                           const std::array<std::array<double, 2>, 2>& of_tilt) {
  Matrix4 all = Matrix4::Zero();
  for (int d = 0; d < 2; ++d) {
    const auto i = static_cast<std::size_t>(d);
    all(d, d) = of_centre[i];
    all(d, 2 + d) = all(2 + d, d) = of_tilt[i][0];
    all(2 + d, 2 + d) = of_tilt[i][1];
  }
  return all;
}

// Sums over the body of mass times place along the shaft, to the powers 0, 1 and 2.
std::array<double, 3> inertias(const Parameters& p, bool with_balls) {
  std::array<double, 3> sums{1.0, 0.0, p.tilt.transverse_inertia};
  for (std::size_t i = 0; with_balls && i < static_cast<std::size_t>(p.balls); ++i) {
    const double z = p.tilt.plane[i];
    sums = {sums[0] + p.mass[i], sums[1] + z * p.mass[i], sums[2] + z * z * p.mass[i]};
  }
  return sums;
}

// Without gyroscopic moments, from these sums.
Eigen::MatrixXd inertia_matrix(const std::array<double, 3>& m) {
  return of_centre_and_tilt({m[0], m[0]}, {{{m[1], m[2]}, {m[1], m[2]}}});
}

// Of equal supports. `polar`: Jp of forward whirl, -Jp of backward whirl. Inertia v = (1/speed^2) stiffness v.
std::vector<double> circular(const Parameters& p, const std::array<double, 3>& m, double polar) {
  const double k11 = p.stiffness[0], k12 = p.tilt.stiffness[0][0], k22 = p.tilt.stiffness[0][1];
  const double m22 = m[2] - polar;
  const double a = k11 * k22 - k12 * k12, b = 0.5 * (k11 * m22 + k22 * m[0] - 2.0 * k12 * m[1]),
               c = m[0] * m22 - m[1] * m[1];
  const double larger = (b + std::copysign(std::sqrt(std::max(0.0, b * b - a * c)), b)) / a;
  std::vector<double> speeds;
  for (const double square : {larger, larger == 0.0 ? 0.0 : c / (a * larger)})
    if (square > 0.0) speeds.push_back(1.0 / std::sqrt(square));
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

// Every speed of whirl on unequal supports. With equal ones each would appear for X and for Y.
std::vector<double> all_whirl_speeds(const Parameters& p, bool with_balls) {
  // With Y a quarter of a turn behind X all is real: stiffness times v is speed^2 times inertia times v.
  const std::array<double, 3> m = inertias(p, with_balls);
  Eigen::MatrixXd inertia = inertia_matrix(m);
  inertia(2, 3) = inertia(3, 2) = -p.tilt.polar_inertia;
  const Eigen::MatrixXd stiffness = of_centre_and_tilt(p.stiffness, p.tilt.stiffness);
  const Eigen::VectorXcd inverse_squares = dense::eigenvalues(dense::inverse(stiffness) * inertia);
  std::vector<double> speeds;
  const double nothing = 1e-13 * inverse_squares.cwiseAbs().maxCoeff();
  for (const std::complex<double>& square : inverse_squares)
    if (square.real() > nothing) speeds.push_back(1.0 / std::sqrt(square.real()));
  std::sort(speeds.begin(), speeds.end());
  return speeds;
}

}  // namespace

WhirlSpeeds whirl_speeds(const Parameters& p, bool with_balls) {
  const bool equal = p.stiffness[0] == p.stiffness[1] && p.tilt.stiffness[0] == p.tilt.stiffness[1];
  if (!equal) return {{}, {}, all_whirl_speeds(p, with_balls)};
  const std::array<double, 3> m = inertias(p, with_balls);
  return {circular(p, m, p.tilt.polar_inertia), circular(p, m, -p.tilt.polar_inertia), {}};
}

// Half the longer axis of an ellipse.
std::array<ShaftVibration::Amplitude, 2> ShaftVibration::force_on(const Bearing& bearing, double speed) const {
  std::array<Amplitude, 2> taken = at(bearing.at);
  for (std::size_t d = 0; d < 2; ++d) taken[d] *= Amplitude(bearing.stiffness[d], speed * bearing.damping[d]);
  return taken;
}

double ShaftVibration::farthest(double place) const {
  const std::array<Amplitude, 2> v = at(place);
  return std::sqrt(0.5 * (std::norm(v[0]) + std::norm(v[1]) + std::abs(v[0] * v[0] + v[1] * v[1])));
}

double slowest_decay(const Parameters& p, double speed) {
  const std::array<double, 3> m = inertias(p, true);
  Eigen::MatrixXd dampers = of_centre_and_tilt(p.damping, p.tilt.damping);
  dampers(2, 3) += speed * p.tilt.polar_inertia;  // gyroscopic
  dampers(3, 2) -= speed * p.tilt.polar_inertia;
  const Eigen::MatrixXd inverse = dense::inverse(inertia_matrix(m));
  Eigen::MatrixXd rates = Eigen::MatrixXd::Zero(8, 8);
  rates.topRightCorner(4, 4).setIdentity();
  rates.bottomLeftCorner(4, 4) = -inverse * of_centre_and_tilt(p.stiffness, p.tilt.stiffness);
  rates.bottomRightCorner(4, 4) = -inverse * dampers;
  return -dense::eigenvalues(rates).real().maxCoeff();
}

ShaftVibration shaft_vibration(const Parameters& p, double speed, const double* held) {
  using Amplitude = ShaftVibration::Amplitude;
  const double w2 = speed * speed, jp = p.tilt.polar_inertia;
  const std::array<double, 3> m = inertias(p, held != nullptr);
  const Eigen::MatrixXcd supports =
      of_centre_and_tilt(p.stiffness, p.tilt.stiffness).cast<Amplitude>() +
      Amplitude(0.0, speed) * of_centre_and_tilt(p.damping, p.tilt.damping).cast<Amplitude>();
  Eigen::MatrixXcd a = supports;
  a.diagonal() -= Amplitude(w2) * Eigen::Vector4cd(m[0], m[0], m[2], m[2]);
  for (int d = 0; d < 2; ++d) {
    a(d, 2 + d) -= w2 * m[1];
    a(2 + d, d) -= w2 * m[1];
  }
  a(2, 3) += Amplitude(0.0, w2 * jp);  // gyroscopic
  a(3, 2) -= Amplitude(0.0, w2 * jp);
  Amplitude centre = std::polar(p.eccentricity, p.eccentricity_angle), couple = p.tilt.couple();
  for (std::size_t i = 0; held && i < static_cast<std::size_t>(p.balls); ++i) {
    const Amplitude one = std::polar(p.mass[i], held[i]);
    centre += one;
    couple += p.tilt.plane[i] * one;
  }
  const Amplitude behind(0.0, -1.0);
  const Eigen::Vector4cd unbalance(centre, behind * centre, couple, behind * couple);
  const Eigen::VectorXcd v = dense::inverse(a) * (w2 * unbalance), f = supports * v;
  return {{v[0], v[1]}, {v[2], v[3]}, {f[0], f[1]}};
}

}  // namespace equipoise::model
