// Numbers of rotors that tilt.
#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "equipoise/base/error.hpp"
#include "equipoise/mechanics/whirl.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"
#include "equipoise/publications/measures.hpp"
#include "equipoise/publications/trajectories.hpp"
#include "equipoise/words/publications.hpp"

namespace equipoise::measures {

double shaft_vibration(const model::Parameters& p, double speed, std::array<double, 2> places) {
  const model::ShaftVibration v = model::shaft_vibration(p, speed);
  return 0.5 * (v.farthest(places[0]) + v.farthest(places[1]));
}

Estimate critical_speed(const Study& study, int number) {
  const std::vector<double> speeds = model::all_whirl_speeds(study.parameters, false);
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
