// Numbers from trajectories, ensembles and linear theory.
#include "equipoise/extras/publications/measures.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/publications/trajectories.hpp"
#include "equipoise/extras/words/publications.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise::measures {

namespace {

// Steps at which a trajectory is looked at: a sixtieth of a turn at the speeds of these studies.
constexpr double look = 0.05;

std::vector<double> times_between(double from, double until) {
  std::vector<double> times;
  const auto steps = static_cast<int>(std::ceil((until - from) / look));
  for (int k = 0; k <= steps; ++k) times.push_back(from + (until - from) * k / steps);
  return times;
}

double top(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

// Mean of both ends of the piece of shaft as long as the race is wide; of a rotor that does not tilt that of its
// centre.
std::vector<double> deflections(const Trajectory& run) {
  std::vector<double> all = run.radial;
  for (std::size_t k = 0; run.tilts && k < all.size(); ++k)
    all[k] = 0.5 * (std::hypot(run.x[k] + run.tilt_x[k], run.y[k] + run.tilt_y[k]) +
                    std::hypot(run.x[k] - run.tilt_x[k], run.y[k] - run.tilt_y[k]));
  return all;
}

Study without_balls_of(Study study) {
  study.parameters.balls = 0;
  study.initial.phi = {};
  return study;
}

double growth(const Study& study, int number = 0) {
  const model::System system(study.parameters, study.speed_profile().final_speed());
  const auto angles = balanced_angles(model::balanced_states(system), study.parameters);
  const auto rates = angles ? balanced_rates(system, *angles, false) : std::nullopt;
  if (!rates) throw RunError(words::publications::no_balance);
  return rates->rates.at(static_cast<std::size_t>(number)).real();
}

// Where `holds` begins to be true.
template <class Holds>
double first_where(double low, double high, const Holds& holds) {
  for (double middle = 0.5 * (low + high); middle > low && middle < high; middle = 0.5 * (low + high))
    (holds(middle) ? high : low) = middle;
  return high;
}

}  // namespace

Trajectory follow(const Study& study, double from, double until) {
  Trajectory trajectory = simulate(study, times_between(from, until));
  if (trajectory.status != IntegrationStatus::done) throw RunError(words::publications::lost_on_the_way);
  return trajectory;
}

// Half a look off the top of a curve no faster than rotor and supports.
double missed(const Study& study) {
  const double fastest = 1.0 + std::fabs(study.speed_profile().final_speed());
  return 0.5 * std::pow(0.5 * look * fastest, 2);
}

Estimate highest(const Study& study, double from, double until) {
  const double value = top(deflections(follow(study, from, until)));
  return {value, (followed + missed(study)) * value};
}

Estimate highest_of_irregular(const Study& study, double from, double until) {
  constexpr int runs = 8;
  constexpr double apart = 1e-3;
  double sum = 0.0, squares = 0.0;
  for (int k = 0; k < runs; ++k) {
    Study one = study;
    one.initial.phi[0] += apart * k / runs;
    const double value = top(deflections(follow(one, from, until)));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / runs;
  return {mean, 2.0 * std::sqrt(std::max(0.0, squares / runs - mean * mean) * runs / (runs - 1.0))};
}

Estimate settled_without_balls(const Study& study) {
  const Study alone = without_balls_of(study);
  const double damping = std::min(alone.parameters.damping[0], alone.parameters.damping[1]);
  const double settled = 2.0 * 23.0 / damping;  // free vibration has fallen to e^-23
  const double value = deflections(follow(alone, settled, settled + 10.0)).back();
  return {value, followed * value};
}

Estimate settled_without_balls_um(const Study& study) {
  const Estimate here = settled_without_balls(study);
  const double unit = study.scales->length * 1e6;
  return {here.value * unit, here.error * unit};
}

Estimate least_mass(const Study& study) {
  const double mass = first_where(0.0, 1.0, [&](double each) {
    model::Parameters p = study.parameters;
    for (int i = 0; i < p.balls; ++i) p.mass[i] = each;
    return model::balanced_states(p).kind != model::BalancedStates::Kind::none;
  });
  constexpr double rounding = 1e-12;
  return {mass, rounding};
}

Estimate settled_speed(const Study& study, double until) {
  const std::vector<double> speed = follow(study, 0.9 * until, until).psi_dot;
  const auto [low, high] = std::minmax_element(speed.begin(), speed.end());
  double sum = 0.0;
  for (const double s : speed) sum += s;
  return {sum / static_cast<double>(speed.size()), 0.5 * (*high - *low) + followed};
}

Estimate balanced_percent(const Study& study, const RunOptions& options) {
  BasinOptions run;
  static_cast<RunOptions&>(run) = options;
  run.progress = {};
  const BasinResult result = basin(study, run);
  const Share& share = result.attractors.front().share;
  return {100.0 * share.share, 100.0 * std::max(share.high - share.share, share.share - share.low)};
}

Estimate rate_near_balance(const Study& study, int number) {
  const double rate = growth(study, number);
  constexpr double rounding = 1e-9;  // of an eigenvalue that is a thousandth of the largest
  return {rate * study.scales->frequency, rounding * study.scales->frequency};
}

Estimate boundary(const Study& study, double low, double high, void (*set)(Study& study, double value)) {
  Study one = study;
  const auto stable = [&](double value) {
    set(one, value);
    return growth(one) < 0.0;
  };
  const bool above = stable(high);
  constexpr double rounding = 1e-7;  // of multipliers over a turn
  return {first_where(low, high, [&](double value) { return stable(value) == above; }), rounding};
}

void at_speed(Study& study, double speed) { study.speed.speed = speed; }

Estimate boundary(const Study& study, double low, double high) { return boundary(study, low, high, at_speed); }

Estimate stable_from(const Study& study, double low, double high) {
  const double unit = study.scales->frequency;
  const double speed = boundary(study, low / unit, high / unit).value;
  constexpr double rounding = 1e-6;
  return {speed * unit, rounding};
}

Estimate resonance(const Study& study, double low, double high, std::array<double, 2> places) {
  constexpr double step = 0.001;
  const model::Parameters alone = without_balls_of(study).parameters;
  double best = low, most = 0.0;
  for (double w = low; w <= high; w += step) {
    const double deflection = shaft_vibration(alone, w, places);
    if (deflection > most) best = w;
    most = std::max(most, deflection);
  }
  return {best, step};
}

double jeffcott_radius(const model::Parameters& p, double speed) {
  const double w2 = speed * speed;
  return p.eccentricity * w2 / std::hypot(p.stiffness[0] - w2, p.damping[0] * speed);
}

double sommerfeld_speed(const Study& study, double low, double high) {
  const model::Parameters& p = study.parameters;
  const model::DriveSegment motor = model::drive_segments(study.motor()).back();
  const double falling = motor.torque(0.0, low, 0.0) - p.damping[0] * low * std::pow(jeffcott_radius(p, low), 2);
  return first_where(low, high, [&](double w) {
    const double left = motor.torque(0.0, w, 0.0) - p.damping[0] * w * std::pow(jeffcott_radius(p, w), 2);
    return (left < 0.0) == (falling > 0.0);
  });
}

}  // namespace equipoise::measures
