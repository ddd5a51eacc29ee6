// Distance from a curve's chords, and of special points from each other.
#include "equipoise/curves/chart_curves.hpp"

#include <algorithm>
#include <cmath>

namespace equipoise {

using Eigen::VectorXd;

bool is_known(const BalancePlane& plane, const BifurcationChart& chart, CurveKind kind, const std::string& of,
              const VectorXd& at, double frequency) {
  // A curve's places are nearer to each other than CurveFollower::longest_step; it turns by less than 0.1 between two.
  constexpr double beside = 1e-3;
  for (const ChartCurve& curve : chart.curves) {
    if (curve.kind != kind || curve.of != of) continue;
    for (std::size_t k = 1; k < curve.points.size(); ++k) {
      const CurvePoint &p = curve.points[k - 1], &q = curve.points[k];
      const VectorXd a = plane.place(p.x, p.y), chord = plane.place(q.x, q.y) - a, offset = at - a;
      const double length = std::max(chord.squaredNorm(), 1e-300);
      const double part = std::clamp(offset.dot(chord) / length, 0.0, 1.0);
      if ((offset - part * chord).norm() > beside) continue;
      if (kind != CurveKind::hopf || std::fabs(p.frequency - frequency) < 0.05 * (1.0 + frequency)) return true;
    }
  }
  return false;
}

void add_curve(const BalancePlane& plane, CurveKind kind, const std::string& of, const FollowedCurve& curve,
               BifurcationChart& chart) {
  ChartCurve found{kind, of, {}, curve.ends(), curve.error()};
  for (const CurvePlace& p : curve.places()) found.points.push_back(p.point);
  const auto known = [&](const SpecialPoint& point) {
    const VectorXd at = plane.place(point.x, point.y);
    return std::any_of(chart.specials.begin(), chart.specials.end(), [&](const SpecialPoint& other) {
      return other.kind == point.kind && chart.curves[other.curve].of == of &&
             (plane.place(other.x, other.y) - at).norm() < 1e-7;
    });
  };
  std::vector<SpecialPoint> fresh;
  for (SpecialPoint special : curve.specials()) {
    special.curve = chart.curves.size();
    if (!known(special)) fresh.push_back(std::move(special));
  }
  found.error = std::max(found.error, curve.error());
  chart.curves.push_back(std::move(found));
  chart.specials.insert(chart.specials.end(), fresh.begin(), fresh.end());
}

}  // namespace equipoise
