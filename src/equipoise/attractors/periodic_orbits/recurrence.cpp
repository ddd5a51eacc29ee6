// Returns of a trajectory; distances from periodic orbits by cubic Hermite interpolation.
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/hermite.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

// A return must be closer than this fraction of the trajectory's typical distance from its last state.
constexpr double close_share = 0.3;
// The longest recurrence known takes twenty turns of a ball: five periods of V4, next to which it exists at Omega =
// 4.4.
constexpr double most_turns = 24.5;
// Interpolation errs by rate^4 step^4/384 of a harmonic's size: 2e-8 at 0.05 rad a step.
constexpr double radians_per_step = 0.05;
constexpr int most_steps = 40000;

}  // namespace

StateDifference::StateDifference(const model::System& system)
    : angles_(system.angles()), inverse_size_(system.scale().cwiseInverse()) {
  inverse_size_.segment(2, 2).setConstant(1.0 / (system.scale()[0] * std::max(1.0, std::fabs(system.pace()))));
}

Eigen::VectorXd StateDifference::operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  Eigen::VectorXd d = (a - b).cwiseProduct(inverse_size_);
  for (const auto& [place, turn] : angles_) d[place] = std::remainder(d[place], turn);
  return d;
}

namespace {

// The closest approach of a trajectory around step k, by a parabola through three squared distances: time, and squared
// distance. Empty if the middle one is not the least.
std::optional<Return> closest_around(const std::vector<double>& squares, std::size_t k, double spacing) {
  if (k + 1 >= squares.size()) return std::nullopt;
  const double before = squares[k - 1], here = squares[k], after = squares[k + 1];
  if (here > before || here > after) return std::nullopt;
  const double bend = before - 2.0 * here + after, slope = 0.5 * (after - before);
  const double shift = bend > 0.0 ? -slope / bend : 0.0;
  return Return{(static_cast<double>(k) + shift) * spacing, std::max(0.0, here + 0.5 * slope * shift)};
}

}  // namespace

std::vector<Return> returns_to_last(const model::System& system, const std::vector<Eigen::VectorXd>& samples,
                                    double spacing, const StateDifference& difference, int most, double reach,
                                    double longest_multiple) {
  const bool stroboscopic = system.section() == model::Section::stroboscopic;
  const Eigen::VectorXd& last = samples.back();
  std::vector<double> squares;  // of distances, by steps back
  squares.reserve(samples.size());
  double sum = 0.0;
  for (auto at = samples.rbegin(); at != samples.rend(); ++at) {
    squares.push_back(difference(*at, last).squaredNorm());
    sum += squares.back();
  }
  const auto angles = system.angles();
  const auto too_far = [&](const Eigen::VectorXd& then) {
    return std::any_of(angles.begin(), angles.end(), [&](const auto& angle) {
      return std::fabs(last[angle.place] - then[angle.place]) > most_turns * angle.turn;
    });
  };
  double record = close_share * close_share * sum / static_cast<double>(squares.size());
  std::vector<Return> returns;
  for (std::size_t k = 1; k < squares.size() && static_cast<int>(returns.size()) < most; ++k) {
    const auto now =
        stroboscopic ? Return{static_cast<double>(k) * spacing, squares[k]} : closest_around(squares, k, spacing);
    if (!now) continue;
    const Eigen::VectorXd& then = samples[samples.size() - 1 - k];
    if (stroboscopic ? std::fabs(system.speed()) * now->time > most_turns * two_pi : too_far(then)) break;
    if (!stroboscopic && !returns.empty() && now->time > longest_multiple * returns.front().time) break;
    const bool one_section = stroboscopic && k == 1 && now->distance < reach * reach;
    if (!one_section && now->distance >= record) continue;
    returns.push_back({now->time, std::sqrt(now->distance)});
    record = std::min(record, 0.25 * now->distance);
  }
  return returns;
}

OrbitCurve::OrbitCurve(const model::System& system, const PeriodicOrbit& orbit) : difference_(system) {
  if (orbit.imposed) {
    states_ = orbit.nodes;
    return;
  }
  double fastest = 1.0;
  for (const Eigen::VectorXd& state : orbit.nodes) fastest = std::max(fastest, std::fabs(system.speed(state)));
  const int count = static_cast<int>(
      std::clamp(std::ceil(orbit.period * fastest / radians_per_step), 64.0, static_cast<double>(most_steps)));
  step_ = orbit.period / count;
  states_ = sample_orbit(system, orbit, count);
  states_.push_back(states_.front());
  const auto angles = system.angles();
  for (std::size_t i = 0; i < angles.size(); ++i) states_.back()[angles[i].place] += angles[i].turn * orbit.winding[i];
  for (const Eigen::VectorXd& state : states_) rates_.push_back(model::rate(system, state));
}

double OrbitCurve::distance(const Eigen::VectorXd& state) const {
  const auto distance_to = [&](const Eigen::VectorXd& point) { return difference_.distance(point, state); };
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < count(); ++k) {
    const double d = distance_to(states_[k]);
    if (d < least) {
      least = d;
      nearest = k;
    }
  }
  return rates_.empty() ? least : std::min(least, least_beside(nearest, distance_to));
}

double OrbitCurve::least(const DistanceTo& distance_to, double near) const {
  std::vector<double> distances;
  for (std::size_t k = 0; k < count(); ++k) distances.push_back(distance_to(states_[k]));
  double least = *std::min_element(distances.begin(), distances.end());
  for (std::size_t k = 0; k < rates_.size() && k < count(); ++k) {
    const double here = distances[k], moves = difference_.length(rates_[k]) * step_;
    const bool lowest = here <= distances[(k + 1) % count()] && here <= distances[(k + count() - 1) % count()];
    if (lowest && here < moves + near) least = std::min(least, least_beside(k, distance_to));
  }
  return least;
}

Eigen::VectorXd OrbitCurve::at(double share) const {
  const double place = share * static_cast<double>(count());
  if (rates_.empty()) return states_[static_cast<std::size_t>(std::lround(place)) % count()];
  const std::size_t k = std::min(static_cast<std::size_t>(place), count() - 1);
  return on_arc(k, place - static_cast<double>(k));
}

Eigen::VectorXd OrbitCurve::on_arc(std::size_t k, double share) const {
  return hermite(share, step_, states_[k], rates_[k], states_[k + 1], rates_[k + 1]);
}

// On the arcs that meet at a sample.
double OrbitCurve::least_beside(std::size_t sample, const DistanceTo& distance_to) const {
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t k : {sample, (sample + count() - 1) % count()}) {
    double low = 0.0, high = 1.0;
    for (int round = 0; round < 40; ++round) {  // thirds: on so short an arc the distance has one minimum
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      if (distance_to(on_arc(k, a)) < distance_to(on_arc(k, b)))
        high = b;
      else
        low = a;
    }
    least = std::min(least, distance_to(on_arc(k, 0.5 * (low + high))));
  }
  return least;
}

}  // namespace equipoise
