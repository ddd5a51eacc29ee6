// Bisection between neighbours, and what an eigenvalue does there; curves that are known already are passed by.
#include "equipoise/curves/curve_starts.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/curves/balance_curve.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

struct CurveStart {
  CurveKind kind = CurveKind::hopf;
  VectorXd at;
  EigenPair pair;
};

class CurveSearch {
 public:
  CurveSearch(const BalancePlane& plane, const StopFlag* stop, BifurcationChart& chart)
      : plane_(plane), stop_(stop), chart_(chart), grid_(chart.plane) {}

  void run() {
    for (int row = 0; row < grid_.y.pixels; ++row)
      for (int column = 0; column < grid_.x.pixels; ++column) {
        if (is_set(stop_)) return;
        if (column + 1 < grid_.x.pixels) look(column, row, column + 1, row);
        if (row + 1 < grid_.y.pixels) look(column, row, column, row + 1);
      }
  }

 private:
  VectorXd place(int column, int row) const { return plane_.place(grid_.x.centre(column), grid_.y.centre(row)); }

  void look(int column, int row, int next_column, int next_row) {
    const BalancePoint &a = grid_.points[grid_.at(column, row)], &b = grid_.points[grid_.at(next_column, next_row)];
    const VectorXd from = place(column, row), to = place(next_column, next_row);
    const bool has_a = std::isfinite(a.growth), has_b = std::isfinite(b.growth);
    if (has_a && has_b && a.unstable != b.unstable) return rates_cross(from, to, a.unstable);
    if ((a.kind == BalanceKind::none) != (b.kind == BalanceKind::none) && a.margin * b.margin < 0.0)
      follow({CurveKind::existence, between_signs(from, to, a.margin), {}});
  }

  void rates_cross(const VectorXd& from, const VectorXd& to, int unstable) {
    VectorXd same = from, other = to;
    for (int k = 0; k < 30; ++k) {
      const VectorXd middle = 0.5 * (same + other);
      const auto spectrum = plane_.spectrum(middle);
      if (!spectrum) return;
      (spectrum->unstable() == unstable ? same : other) = middle;
    }
    const auto spectrum = plane_.spectrum(other);
    if (!spectrum) return;
    const auto& rates = spectrum->rates;
    const auto nearest = std::min_element(rates.begin(), rates.end(), [](const auto& p, const auto& q) {
      return std::fabs(p.real()) < std::fabs(q.real());
    });
    if (nearest->imag() == 0.0) return follow({CurveKind::zero, other, {}});
    follow({CurveKind::hopf, other, {0.0, std::norm(*nearest), {}}});
  }

  VectorXd between_signs(const VectorXd& from, const VectorXd& to, double margin) const {
    VectorXd same = from, other = to;
    for (int k = 0; k < 30; ++k) {
      const VectorXd middle = 0.5 * (same + other);
      const auto here = plane_.margin(middle);
      (here && *here * margin > 0.0 ? same : other) = middle;
    }
    return other;
  }

  void follow(const CurveStart& start) {
    if (is_known(plane_, chart_, start.kind, of_balance, start.at, std::sqrt(std::max(0.0, start.pair.product))))
      return;
    BalanceCurve curve(plane_, start.kind, start.pair);
    if (curve.follow(start.at, stop_)) add_curve(plane_, start.kind, of_balance, curve, chart_);
  }

  const BalancePlane& plane_;
  const StopFlag* stop_;
  BifurcationChart& chart_;
  const StabilityPlane& grid_;
};

}  // namespace

bool is_known(const BalancePlane& plane, const BifurcationChart& chart, CurveKind kind, const std::string& of,
              const VectorXd& at, double frequency) {
  // A curve's places are nearer to each other than CurveFollower::longest_step; it turns by less than 0.1 between two.
  constexpr double beside = 1e-3;
  for (const ChartCurve& curve : chart.curves) {
    // Cycles may be born of one state and end in another.
    if (curve.kind != kind || (curve.of != of && !is_of_cycles(kind))) continue;
    for (std::size_t k = 1; k < curve.points.size(); ++k) {
      const CurvePoint &p = curve.points[k - 1], &q = curve.points[k];
      const VectorXd a = plane.place(p.x, p.y), chord = plane.place(q.x, q.y) - a, offset = at - a;
      const double length = std::max(chord.squaredNorm(), 1e-300);
      const double part = std::clamp(offset.dot(chord) / length, 0.0, 1.0);
      if ((offset - part * chord).norm() > beside) continue;
      if ((kind != CurveKind::hopf && !is_of_cycles(kind)) ||
          std::fabs(p.frequency - frequency) < 0.05 * (1.0 + frequency))
        return true;
    }
  }
  return false;
}

void add_curve(const BalancePlane& plane, CurveKind kind, const std::string& of, const FollowedCurve& curve,
               BifurcationChart& chart) {
  ChartCurve found{kind, of, {}, curve.ends(), curve.error()};
  for (const CurvePlace& p : curve.places()) found.points.push_back(p.point);
  const double same = is_of_cycles(kind) ? 1e-6 : 1e-7;
  const auto known = [&](const SpecialPoint& point) {
    const VectorXd at = plane.place(point.x, point.y);
    return std::any_of(chart.specials.begin(), chart.specials.end(), [&](const SpecialPoint& other) {
      const ChartCurve& its = chart.curves[other.curve];
      return other.kind == point.kind && (is_of_cycles(its.kind) || its.of == of) &&
             (plane.place(other.x, other.y) - at).norm() < same;
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

void add_curves(const BalancePlane& plane, const StopFlag* stop, BifurcationChart& chart) {
  CurveSearch(plane, stop, chart).run();
}

}  // namespace equipoise
