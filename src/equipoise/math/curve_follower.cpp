// Predictor along the tangent, Newton's method across it, step control by the angle between tangents.
#include "equipoise/math/curve_follower.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/math/dense.hpp"

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

std::optional<VectorXd> CurveFollower::at_plane(const VectorXd& guess, const VectorXd& normal) const {
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

std::optional<CurveFollower::Step> CurveFollower::next(const Step& from, double& step) const {
  constexpr double sharpest = 0.1, flat = 0.03;  // radians between tangents
  for (;; step *= 0.5) {
    if (step < shortest_step) return std::nullopt;
    const VectorXd guess = from.point + step * from.tangent;
    const auto point = at_plane(guess, from.tangent);
    const auto along = point ? tangent(*point, from.tangent) : std::nullopt;
    if (!along) continue;
    const double turn = std::acos(std::clamp(along->dot(from.tangent), -1.0, 1.0));
    if (turn > sharpest && step > 1e-5) continue;
    if (turn < flat) step = std::min(limits_.longest, 1.5 * step);
    return Step{*point, *along};
  }
}

}  // namespace equipoise
