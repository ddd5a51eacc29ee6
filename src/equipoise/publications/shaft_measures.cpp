// Numbers of rotors that tilt.
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "equipoise/base/error.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"
#include "equipoise/publications/measures.hpp"
#include "equipoise/publications/trajectories.hpp"
#include "equipoise/words/publications.hpp"

namespace equipoise::measures {

namespace {

using Amplitude = std::complex<double>;
using Matrix4 = Eigen::Matrix4d;

// Of the supports, for X, Y and the slopes along them.
Matrix4 support(const std::array<double, 2>& of_centre, const std::array<std::array<double, 2>, 2>& of_tilt) {
  Matrix4 all = Matrix4::Zero();
  for (int d = 0; d < 2; ++d) {
    const auto i = static_cast<std::size_t>(d);
    all(d, d) = of_centre[i];
    all(d, 2 + d) = all(2 + d, d) = of_tilt[i][0];
    all(2 + d, 2 + d) = of_tilt[i][1];
  }
  return all;
}

// Half the longer axis of the ellipse that the real part of v e^{i t} runs along.
double longer_half_axis(Amplitude x, Amplitude y) {
  return std::sqrt(0.5 * (std::norm(x) + std::norm(y) + std::abs(x * x + y * y)));
}

}  // namespace

double shaft_vibration(const model::Parameters& p, double speed, std::array<double, 2> places) {
  const double w2 = speed * speed, jt = p.tilt.transverse_inertia, jp = p.tilt.polar_inertia;
  Eigen::MatrixXcd a = support(p.stiffness, p.tilt.stiffness).cast<Amplitude>() +
                       Amplitude(0.0, speed) * support(p.damping, p.tilt.damping).cast<Amplitude>();
  a.diagonal() -= Amplitude(w2) * Eigen::Vector4cd(1.0, 1.0, jt, jt);
  a(2, 3) += Amplitude(0.0, w2 * jp);  // gyroscopic
  a(3, 2) -= Amplitude(0.0, w2 * jp);
  const Amplitude centre = std::polar(p.eccentricity, p.eccentricity_angle), couple = p.tilt.couple();
  const Amplitude behind(0.0, -1.0);
  const Eigen::Vector4cd force(centre, behind * centre, couple, behind * couple);
  const Eigen::VectorXcd v = dense::inverse(a) * (w2 * force);
  double sum = 0.0;
  for (const double z : places) sum += longer_half_axis(v[0] + z * v[2], v[1] + z * v[3]);
  return 0.5 * sum;
}

Estimate critical_speed(const Study& study, int number) {
  const model::Parameters& p = study.parameters;
  // With Y a quarter of a turn behind X all is real: stiffness times v is speed^2 times inertia times v.
  Eigen::MatrixXd inertia = Matrix4::Identity();
  inertia(2, 2) = inertia(3, 3) = p.tilt.transverse_inertia;
  inertia(2, 3) = inertia(3, 2) = -p.tilt.polar_inertia;
  const Eigen::VectorXcd squares =
      dense::eigenvalues(dense::inverse(inertia) * Eigen::MatrixXd(support(p.stiffness, p.tilt.stiffness)));
  std::vector<double> speeds;
  for (const Amplitude& square : squares)
    if (square.real() > 0.0) speeds.push_back(std::sqrt(square.real()));
  std::sort(speeds.begin(), speeds.end());
  constexpr double rounding = 1e-12;
  return {speeds.at(static_cast<std::size_t>(number)), rounding};
}

Estimate largest_at(const Study& study, std::array<double, 2> places, double from, double until) {
  const Trajectory run = follow(study, from, until);
  double sum = 0.0;
  for (const double z : places) {
    double most = 0.0;
    for (std::size_t k = 0; k < run.t.size(); ++k)
      most = std::max(most, std::hypot(run.x[k] + z * run.tilt_x[k], run.y[k] + z * run.tilt_y[k]));
    sum += most;
  }
  return {0.5 * sum, 0.5 * sum * (followed + missed(study))};
}

Estimate least_ball_rate(const Study& study, double until) {
  const Trajectory run = follow(study, 0.0, until);
  double least = 0.0;
  for (const std::vector<double>& rate : run.phi_dot)
    least = std::min(least, *std::min_element(rate.begin(), rate.end()));
  return {least, std::fabs(least) * (followed + missed(study))};
}

Estimate last_angle(const Study& study, int ball, double until) {
  return {follow(study, until - 1.0, until).phi.at(static_cast<std::size_t>(ball)).back(), followed};
}

Estimate lags_until(const Study& study, double from, double until) {
  constexpr double lag = 0.1;
  const Trajectory run = follow(study, from, until);
  double last = run.psi_dot.front();
  for (const std::vector<double>& rate : run.phi_dot)
    for (std::size_t k = 0; k < rate.size(); ++k)
      if (rate[k] < -lag) last = std::max(last, run.psi_dot[k]);
  return {last, run.psi_dot[1] - run.psi_dot[0] + followed};
}

Estimate ball_speed(const Study& study, double from, double until) {
  const Trajectory run = follow(study, from, until);
  std::vector<double> means;
  for (const std::vector<double>& rate : run.phi_dot) {
    double sum = 0.0;
    for (std::size_t k = 0; k < rate.size(); ++k) sum += run.psi_dot[k] + rate[k];
    means.push_back(sum / static_cast<double>(rate.size()));
  }
  const auto [low, high] = std::minmax_element(means.begin(), means.end());
  return {0.5 * (*low + *high), 0.5 * (*high - *low)};
}

Estimate cycle_period(const Study& study, double from, double until, double about) {
  Study first = study;
  first.speed.speed = from;
  const Trajectory run = follow(first, until - 1.0, until);
  const model::System system(first.parameters, from);
  const model::StateLayout& layout = system.layout();
  Eigen::VectorXd state(layout.size);
  const std::size_t end = run.t.size() - 1;
  state.head<4>() << run.x[end], run.y[end], run.x_dot[end] - from * run.y[end], run.y_dot[end] + from * run.x[end];
  for (int i = 0; i < layout.balls; ++i) {
    state[model::index::phi(i)] = run.phi[static_cast<std::size_t>(i)][end];
    state[model::index::q(i, layout.balls)] = run.phi_dot[static_cast<std::size_t>(i)][end];
  }
  state.segment<4>(layout.tilt) << run.tilt_x[end], run.tilt_y[end], run.tilt_x_dot[end] - from * run.tilt_y[end],
      run.tilt_y_dot[end] + from * run.tilt_x[end];
  std::optional<PeriodicOrbit> orbit = refine_orbit(system, state, about);
  constexpr int steps = 8;
  constexpr double reach = 0.5;
  for (int k = 1; orbit && k <= steps; ++k)
    orbit = continue_orbit({first.parameters, from + (study.speed.speed - from) * k / steps}, *orbit, reach);
  if (!orbit) throw RunError(words::publications::lost_on_the_way);
  constexpr double rounding = 1e-8;
  return {orbit->period, rounding};
}

}  // namespace equipoise::measures
