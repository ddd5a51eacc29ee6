// Returns of a trajectory, and distances from periodic orbits by cubic Hermite interpolation.
#include "equipoise/orbits/recurrence.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {

namespace {

// A return farther off than this share of the trajectory's typical distance from its last state is none.
constexpr double close_share = 0.3;
// The longest recurrence known takes twenty turns of a ball (five times the period of V4, beside which it lives at
// Omega = 4.4).
constexpr double most_turns = 24.5, longest_multiple = 32.5;
// Interpolation errs by rate^4 step^4/384 of a harmonic's size: 2e-8 at 0.05 rad a step.
constexpr double radians_per_step = 0.05;
constexpr int most_steps = 40000;

}  // namespace

StateDifference::StateDifference(const model::Parameters& p, double speed)
    : balls_(p.balls), inverse_size_(Eigen::VectorXd::Ones(model::dimension(p.balls))) {
  const double length = p.eccentricity + p.total_mass();
  inverse_size_.segment(0, 2).setConstant(1.0 / length);
  inverse_size_.segment(2, 2).setConstant(1.0 / (length * std::max(1.0, std::fabs(speed))));
}

Eigen::VectorXd StateDifference::operator()(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  Eigen::VectorXd d = (a - b).cwiseProduct(inverse_size_);
  for (int i = 0; i < balls_; ++i) d[model::index::phi(i)] = wrapped(d[model::index::phi(i)]);
  return d;
}

std::vector<Return> returns_to_last(const std::vector<Eigen::VectorXd>& samples, double spacing, int balls,
                                    const StateDifference& difference, int most) {
  const Eigen::VectorXd& last = samples.back();
  std::vector<double> squares;  // of the distance, by steps back
  squares.reserve(samples.size());
  double sum = 0.0;
  for (auto at = samples.rbegin(); at != samples.rend(); ++at) {
    squares.push_back(difference(*at, last).squaredNorm());
    sum += squares.back();
  }
  double record = close_share * close_share * sum / static_cast<double>(squares.size());
  std::vector<Return> returns;
  for (std::size_t k = 1; k + 1 < squares.size() && static_cast<int>(returns.size()) < most; ++k) {
    const double before = squares[k - 1], here = squares[k], after = squares[k + 1];
    if (here > before || here > after) continue;
    const double bend = before - 2.0 * here + after, slope = 0.5 * (after - before);
    const double shift = bend > 0.0 ? -slope / bend : 0.0;
    const double lowest = std::max(0.0, here + 0.5 * slope * shift);
    const double time = (static_cast<double>(k) + shift) * spacing;
    const Eigen::VectorXd turned = (last - samples[samples.size() - 1 - k]).segment(model::index::phi(0), balls);
    if (turned.cwiseAbs().maxCoeff() > most_turns * two_pi) break;
    if (!returns.empty() && time > longest_multiple * returns.front().time) break;
    if (lowest >= record) continue;
    returns.push_back({time, std::sqrt(lowest)});
    record = 0.25 * lowest;
  }
  return returns;
}

std::optional<OrbitGuess> shoot(const model::Parameters& p, double speed, const Eigen::VectorXd& state, double time,
                                const StateDifference& difference, double reach) {
  constexpr double tolerance = 1e-9, converged = 1e-4;
  constexpr int most_steps_taken = 10;
  constexpr double least_progress = 0.9;
  const Eigen::Index size = state.size();
  OrbitGuess guess{state, time};
  double previous = reach;
  for (int step = 0; step < most_steps_taken; ++step) {
    const auto flight = follow_derivative(p, speed, guess.state, guess.period, tolerance);
    if (!flight) return std::nullopt;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size + 1);
    right.head(size) = guess.state - flight->end;
    for (int i = 0; i < p.balls; ++i) right[model::index::phi(i)] = wrapped(right[model::index::phi(i)]);
    // (M - 1) d + z' dT = -miss, and d has no part along the motion, which a shift in time would undo.
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size + 1, size + 1);
    matrix.topLeftCorner(size, size) = flight->tangents - Eigen::MatrixXd::Identity(size, size);
    matrix.topRightCorner(size, 1) = model::derivative(p, speed, flight->end.data());
    matrix.bottomLeftCorner(1, size) = model::derivative(p, speed, guess.state.data()).transpose();
    const Eigen::VectorXd change = matrix.partialPivLu().solve(right);
    const double length = difference.length(change.head(size));
    if (!(length <= (step == 0 ? reach : least_progress * previous))) return std::nullopt;
    guess.state += change.head(size);
    guess.period += change[size];
    // A period that halves or doubles belongs to another orbit.
    if (!(guess.period > 0.5 * time && guess.period < 2.0 * time)) return std::nullopt;
    if (difference.distance(guess.state, state) > 2.0 * reach) return std::nullopt;
    if (length < converged) return guess;
    previous = length;
  }
  return std::nullopt;
}

OrbitCurve::OrbitCurve(const model::Parameters& p, double speed, const PeriodicOrbit& orbit) : difference_(p, speed) {
  const double fastest = std::max(1.0, std::fabs(speed));
  const int count = static_cast<int>(
      std::clamp(std::ceil(orbit.period * fastest / radians_per_step), 64.0, static_cast<double>(most_steps)));
  step_ = orbit.period / count;
  states_ = sample_orbit(p, speed, orbit, count);
  states_.push_back(states_.front());
  for (int i = 0; i < p.balls; ++i) states_.back()[model::index::phi(i)] += two_pi * orbit.winding[i];
  for (const Eigen::VectorXd& state : states_) rates_.push_back(model::derivative(p, speed, state.data()));
}

double OrbitCurve::distance(const Eigen::VectorXd& state) const {
  const std::size_t last = states_.size() - 1;
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < last; ++k) {
    const double d = difference_.distance(states_[k], state);
    if (d < least) {
      least = d;
      nearest = k;
    }
  }
  const auto on_arc = [&](std::size_t k, double s) {
    const double r = 1.0 - s;
    const Eigen::VectorXd point = r * r * (1.0 + 2.0 * s) * states_[k] + s * s * (3.0 - 2.0 * s) * states_[k + 1] +
                                  step_ * s * r * (r * rates_[k] - s * rates_[k + 1]);
    return difference_.distance(point, state);
  };
  for (const std::size_t k : {nearest, (nearest + last - 1) % last}) {  // the arcs that meet there
    double low = 0.0, high = 1.0;
    for (int round = 0; round < 40; ++round) {  // thirds: the distance has one minimum on so short an arc
      const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
      if (on_arc(k, a) < on_arc(k, b))
        high = b;
      else
        low = a;
    }
    least = std::min(least, on_arc(k, 0.5 * (low + high)));
  }
  return least;
}

}  // namespace equipoise
