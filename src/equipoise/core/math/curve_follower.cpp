// Predictor along the tangent, Newton's method across it, step control by the angle between tangents.
#include "equipoise/core/math/curve_follower.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/core/math/dense.hpp"

namespace equipoise {

namespace {
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd with_row(const MatrixXd& slopes, const VectorXd& row) {
  MatrixXd square(slopes.rows() + 1, slopes.cols());
  square << slopes, row.transpose();
  return square;
}

VectorXd last_unit(Eigen::Index size) { return VectorXd::Unit(size, size - 1); }
}  // namespace

// Central differences: their error only slows Newton's method, which corrects until the equations hold.
std::optional<MatrixXd> CurveFollower::differences(const VectorXd& at) const {
  constexpr double step = 1e-6;
  MatrixXd result(at.size() - 1, at.size());
  for (Eigen::Index k = 0; k < at.size(); ++k) {
    VectorXd up = at, down = at;
    up[k] += step;
    down[k] -= step;
    const auto above = equations_(up), below = equations_(down);
    if (!above || !below) return std::nullopt;
    result.col(k) = (*above - *below) / (2.0 * step);
  }
  return result;
}

// Newton's method with given slopes, corrected on the way. Empty unless it converges fast.
std::optional<VectorXd> CurveFollower::at_plane_by(MatrixXd& slopes, const VectorXd& guess,
                                                   const VectorXd& normal) const {
  constexpr double slow = 0.5;
  constexpr int most = 8;
  VectorXd point = guess, right(guess.size());
  auto value = equations_(point);
  double last = INFINITY;
  for (int round = 0; value && round < most; ++round) {
    right << -*value, normal.dot(guess - point);
    const VectorXd change = dense::LinearSolver(with_row(slopes, normal)).solve(right);
    const double size = change.norm();
    if (!std::isfinite(size) || size > 0.1 || (round > 0 && size > slow * last)) return std::nullopt;
    point += change;
    last = size;
    value = equations_(point);
    if (!value) return std::nullopt;
    if (size < limits_.precise) {
      error_ = std::max(error_, size);
      return point;
    }
    // What is left is what they were wrong by, unless it is rounding.
    if (size > 30.0 * limits_.precise) slopes += *value * (change.transpose() / (size * size));
  }
  return std::nullopt;
}

std::optional<VectorXd> CurveFollower::at_plane(const VectorXd& guess, const VectorXd& normal) const {
  if (limits_.slopes_are_dear) {
    if (kept_.cols() == guess.size())
      if (auto found = at_plane_by(kept_, guess, normal)) return found;
    const auto fresh = slopes(guess);
    if (!fresh) return std::nullopt;
    kept_ = *fresh;
    return at_plane_by(kept_, guess, normal);
  }
  VectorXd point = guess;
  double last = INFINITY;
  for (int round = 0; round < 12; ++round) {
    const auto value = equations_(point);
    const auto slope = value ? slopes(point) : std::nullopt;
    if (!slope) return std::nullopt;
    VectorXd right(point.size());
    right << -*value, normal.dot(guess - point);
    const VectorXd change = dense::LinearSolver(with_row(*slope, normal)).solve(right);
    const double size = change.norm();
    if (!std::isfinite(size) || size > 0.1 || (round > 3 && size > 2.0 * last)) return std::nullopt;
    point += change;
    last = size;
    if (size < limits_.precise) {
      error_ = std::max(error_, size);
      return equations_(point) ? std::optional(point) : std::nullopt;
    }
  }
  return std::nullopt;
}

std::optional<VectorXd> CurveFollower::tangent(const VectorXd& at, const VectorXd& towards) const {
  const auto slope = slopes(at);
  if (!slope) return std::nullopt;
  if (limits_.slopes_are_dear) kept_ = *slope;
  const VectorXd along = dense::LinearSolver(with_row(*slope, towards)).solve(last_unit(at.size()));
  const double size = along.norm();
  return std::isfinite(size) && size > 0.0 ? std::optional<VectorXd>(along / size) : std::nullopt;
}

std::optional<VectorXd> CurveFollower::nearby(const VectorXd& guess) const {
  const auto slope = slopes(guess);
  if (!slope) return std::nullopt;
  const MatrixXd factor = dense::pivoted_orthogonal_factor(slope->transpose());
  return at_plane(guess, factor.rightCols(1));
}

std::optional<CurveFollower::Step> CurveFollower::step_to(const Step& from, double step) const {
  VectorXd guess = from.point + step * from.tangent;
  if (from.bend.size() > 0) guess += 0.5 * step * step * from.bend;
  const auto point = at_plane(guess, from.tangent);
  if (!point) return std::nullopt;
  Step next{*point, {}, (*point - from.point).norm(), {}, {}};
  next.chord = (*point - from.point) / next.length;
  if (limits_.slopes_are_dear && from.length > 0.0) {
    // Chords are tangents halfway.
    next.bend = (next.chord - from.chord) * (2.0 / (from.length + next.length));
    next.tangent = (next.chord + 0.5 * next.length * next.bend).normalized();
    next.bend -= next.bend.dot(next.tangent) * next.tangent;
    return next;
  }
  const auto along = tangent(*point, from.tangent);
  if (!along) return std::nullopt;
  next.tangent = *along;
  return next;
}

std::optional<CurveFollower::Step> CurveFollower::next(const Step& from, double& step) const {
  for (;; step *= 0.5) {
    if (step < shortest_step) return std::nullopt;
    auto found = step_to(from, step);
    if (!found) continue;
    const double turn = std::acos(std::clamp(found->tangent.dot(from.tangent), -1.0, 1.0));
    if (turn > limits_.sharpest && step > 1e-5) continue;
    if (turn < limits_.flat) step = std::min(limits_.longest, 1.5 * step);
    if (limits_.slopes_are_dear) kept_ -= (kept_ * found->tangent) * found->tangent.transpose();
    return found;
  }
}

}  // namespace equipoise
