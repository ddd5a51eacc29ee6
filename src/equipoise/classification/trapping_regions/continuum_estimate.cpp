// Finds the nearest member, up to an exchange of balls, and uses its form; bounds the distance from all members.
#include "equipoise/classification/trapping_regions/continuum_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <utility>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise {

namespace {

using model::index::phi;
using model::index::q;

// Over about a radian matrices change by as much as themselves.
constexpr double beside = 0.6;

// Balls that move by angles d_i change the unbalance by no more than sum mu_i |d_i| <= |mu| |d|. 0 with an off-centre
// race, whose unbalance in balance is not 0.
double angle_of_unbalance(const model::Parameters& p) {
  if (!p.race_is_centred()) return 0.0;
  return 1.0 / std::sqrt(std::inner_product(p.mass.begin(), p.mass.begin() + p.balls, p.mass.begin(), 0.0));
}

}  // namespace

ContinuumEstimate::ContinuumEstimate(const model::System& system, std::vector<ContinuumMember> members)
    : system_(system),
      interchangeable_(system.parameters().equal_balls()),
      speed_(model::balanced_speed(system).value_or(0.0)),
      scale_(system.scale()),
      members_(std::move(members)) {
  for (const ContinuumMember& m : members_) {
    moved_.push_back(m.centre - model::balanced_state(system_, speed_, m.phi.data()));
    rings_.push_back(ring(m.phi.data()));
  }
}

ContinuumEstimate::Ring ContinuumEstimate::ring(const double* angles) const {
  const int n = system_.balls();
  Ring result;
  std::iota(result.ball.begin(), result.ball.begin() + n, 0);
  const auto angle = [&](int i) { return wrapped_positive(angles[i]); };
  if (interchangeable_)
    std::sort(result.ball.begin(), result.ball.begin() + n, [&](int a, int b) { return angle(a) < angle(b); });
  for (int i = 0; i < n; ++i) result.angle[i] = angle(result.ball[i]);
  return result;
}

// Alike balls on a ring are all nearest to others in the same order, up to where it begins.
ContinuumEstimate::Nearest ContinuumEstimate::nearest(std::size_t left_out, const double* balanced,
                                                      const Eigen::VectorXd& offset) const {
  const int n = system_.balls();
  const Ring mine = ring(balanced);
  Nearest result{0, std::numeric_limits<double>::infinity(), offset};
  int begin = 0;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    if (k == left_out) continue;
    for (int turn = 0; turn < (interchangeable_ ? n : 1); ++turn) {
      double distance = 0.0;
      for (int i = 0; i < n; ++i) {
        const double apart = std::fabs(mine.angle[(i + turn) % n] - rings_[k].angle[i]);
        distance = std::max(distance, std::min(apart, two_pi - apart));
      }
      if (distance >= result.distance) continue;
      result.member = k;
      result.distance = distance;
      begin = turn;
    }
  }
  if (!std::isfinite(result.distance)) return result;
  for (int i = 0; i < n; ++i) {
    const int to = rings_[result.member].ball[i], from = mine.ball[(i + begin) % n];
    result.offset[phi(to)] = offset[phi(from)];
    result.offset[q(to, n)] = offset[q(from, n)];
  }
  return result;
}

std::optional<double> ContinuumEstimate::depth_without(std::size_t left_out, const Eigen::VectorXd& state,
                                                       double factor) const {
  const int n = system_.balls();
  std::array<double, model::max_balls> balanced{};
  for (int i = 0; i < n; ++i) balanced[i] = state[phi(i)];
  if (!model::project_to_balanced(system_, speed_, balanced.data())) return std::nullopt;
  const Nearest near =
      nearest(left_out, balanced.data(), state - model::balanced_state(system_, speed_, balanced.data()));
  if (!(near.distance < beside)) return std::nullopt;
  const ContinuumMember& m = members_[near.member];
  Eigen::VectorXd d = near.offset - moved_[near.member];
  for (int i = 0; i < n; ++i) d[phi(i)] = wrapped(d[phi(i)]);
  d = d.cwiseQuotient(scale_);
  const Eigen::VectorXd s = m.range.transpose() * (d - m.along * (m.left * d));
  return s.dot(m.form * s) / ContinuumOfEquilibria::level(m, factor);
}

ContinuumEstimate::Errors ContinuumEstimate::errors(const ContinuumOfEquilibria& continuum, double factor) const {
  constexpr int directions = 16;
  Errors result;
  Directions draw(continuum.directions());
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const double level = ContinuumOfEquilibria::level(members_[k], factor);
    for (int i = 0; i < directions; ++i)
      if (const auto depth = depth_without(k, continuum.state_at(members_[k], level, draw.next()), factor)) {
        result.shortfall = std::max(result.shortfall, 1.0 / *depth);
        result.excess = std::max(result.excess, *depth);
      }
    result.floor = std::max(result.floor, depth_without(k, members_[k].centre, factor).value_or(0.0));
  }
  return result;
}

OffContinuum::OffContinuum(const model::System& system)
    : system_(system),
      rests_(model::balanced_freedom(system) > 0),
      speed_(model::balanced_speed(system).value_or(0.0)),
      angle_of_unbalance_(angle_of_unbalance(system.parameters())),
      scale_(system.scale()) {}

double OffContinuum::least(const Eigen::VectorXd& state) const {
  if (!rests_) return 0.0;
  const double* angles = &state[phi(0)];
  const Eigen::VectorXd moved = (state - model::balanced_state(system_, speed_, angles)).cwiseQuotient(scale_);
  return std::hypot(moved.norm(), angle_of_unbalance_ * std::abs(model::unbalance(system_.parameters(), angles)));
}

}  // namespace equipoise
