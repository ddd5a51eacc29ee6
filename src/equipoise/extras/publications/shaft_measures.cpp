// Numbers of rotors that tilt.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/cycles/cycle_branch.hpp"
#include "equipoise/extras/publications/measures.hpp"
#include "equipoise/extras/publications/trajectories.hpp"
#include "equipoise/extras/words/publications.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"

namespace equipoise::measures {

namespace {

// The limit cycle at the study's speed: see cycle_period().
PeriodicOrbit followed_cycle(const Study& study, double from, double until, double about) {
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
  return *orbit;
}

}  // namespace

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

Estimate slow_until(const Study& study, double below, double from, double until) {
  const Trajectory run = follow(study, from, until);
  double last = run.psi_dot.front();
  for (const std::vector<double>& rate : run.phi_dot)
    for (std::size_t k = 0; k < rate.size(); ++k)
      if (run.psi_dot[k] + rate[k] < below) last = std::max(last, run.psi_dot[k]);
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
  constexpr double rounding = 1e-8;
  return {followed_cycle(study, from, until, about).period, rounding};
}

Estimate cycle_extent(const Study& study, double from, double until, double about, int axis) {
  constexpr int looks = 400;
  const PeriodicOrbit orbit = followed_cycle(study, from, until, about);
  const model::System system(study.parameters, study.speed.speed);
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::VectorXd& state : sample_orbit(system, orbit, looks)) {
    low = std::min(low, state[axis]);
    high = std::max(high, state[axis]);
  }
  constexpr double missed_between = 1e-3;  // of a wave with a tenth as many looks
  return {high - low, missed_between * (high - low)};
}

Estimate branch_period(const Study& study, double low, double born, double high) {
  const double hopf = boundary(study, born, high).value, speed = study.speed.speed;
  const auto speed_at = [&](const Eigen::VectorXd& at) { return low + at[0] * (high - low); };
  const CycleSystems systems = [&](const Eigen::VectorXd& at) {
    return std::optional(model::System(study.parameters, speed_at(at)));
  };
  const model::System first(study.parameters, hopf);
  const auto angles = balanced_angles(model::balanced_states(first), study.parameters);
  const auto rates = angles ? balanced_rates(first, *angles, false) : std::nullopt;
  if (!rates) throw RunError(words::publications::no_balance);
  CycleStart start{Eigen::VectorXd::Constant(1, (hopf - low) / (high - low)), Eigen::VectorXd::Constant(1, -1.0),
                   Eigen::VectorXd::Zero(first.layout().size), std::fabs(rates->rates.front().imag())};
  for (int i = 0; i < study.parameters.balls; ++i)
    start.state[model::index::phi(i)] = (*angles)[static_cast<std::size_t>(i)];
  const std::vector<CyclePlace> places = cycle_branch(systems, start, nullptr).places;
  for (std::size_t k = 1; k < places.size(); ++k) {
    const double before = speed_at(places[k - 1].at), after = speed_at(places[k].at);
    if ((before - speed) * (after - speed) > 0.0) continue;
    const double part = (speed - before) / (after - before);
    CycleShape guess = places[k - 1].shape;
    guess.period += part * (places[k].shape.period - guess.period);
    for (std::size_t n = 0; n < guess.nodes.size(); ++n)
      guess.nodes[n] += part * (places[k].shape.nodes[n] - guess.nodes[n]);
    const auto orbit = refine_orbit(model::System(study.parameters, speed), guess.nodes, guess.period);
    if (!orbit) break;
    constexpr double rounding = 1e-8;
    return {orbit->period, rounding};
  }
  throw RunError(words::publications::lost_on_the_way);
}

}  // namespace equipoise::measures
