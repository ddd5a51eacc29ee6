// Bisection between places that differ, and what an eigenvalue does there; curves that are known already are passed by.
#include "equipoise/extras/curves/curve_starts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "equipoise/extras/curves/followed_curve.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

class CurveSearch : ChartSearch {
 public:
  CurveSearch(const PlaneStudies& plane, const StopFlag* stop, BifurcationChart& chart)
      : ChartSearch(plane, stop, chart) {}

  void run() {
    look_at_neighbours(
        [&](int column, int row, int next_column, int next_row) { look(column, row, next_column, next_row); });
    if (!grid_.own) return;
    for (const BalanceBoundary& boundary : grid_.own->boundaries) {
      if (is_set(stop_)) return;
      begin_at(boundary);
    }
  }

  // Along rows and columns through boxes that are proved to be stable or unstable.
  void run_between_boxes() {
    const std::vector<BalanceKind> kinds = proved_kinds();
    const auto look_along = [&](bool along_x) {
      for (int line = 0; line < lines; ++line) {
        int last = -1;
        for (int k = 0; k < lines; ++k) {
          if (is_set(stop_)) return;
          const int here = along_x ? line * lines + k : k * lines + line;
          const auto kind = [&](int cell) { return kinds[static_cast<std::size_t>(cell)]; };
          if (kind(here) == BalanceKind::open || kind(here) == BalanceKind::none) continue;
          if (last >= 0 && kind(last) != kind(here)) look_between(centre_of(last), centre_of(here));
          last = here;
        }
      }
    };
    look_along(true);
    look_along(false);
  }

 private:
  static constexpr int lines = 128;  // each way

  static VectorXd centre_of(int cell) {
    const int row = cell / lines;
    return Eigen::Vector2d((cell - row * lines + 0.5) / lines, (row + 0.5) / lines);
  }

  // At the places where the lines cross, rows from below.
  std::vector<BalanceKind> proved_kinds() const {
    std::vector<BalanceKind> kinds(static_cast<std::size_t>(lines) * lines, BalanceKind::open);
    const auto first_from = [](double part) { return std::max(0, static_cast<int>(std::ceil(part * lines - 0.5))); };
    for (const ProofBox& box : chart_.boxes) {
      if (box.kind != BalanceKind::stable && box.kind != BalanceKind::unstable) continue;
      const VectorXd low = plane_.place(box.x[0], box.y[0]), high = plane_.place(box.x[1], box.y[1]);
      for (int row = first_from(low[1]); row < lines && row + 0.5 <= high[1] * lines; ++row)
        for (int column = first_from(low[0]); column < lines && column + 0.5 <= high[0] * lines; ++column)
          kinds[static_cast<std::size_t>(row) * lines + static_cast<std::size_t>(column)] = box.kind;
    }
    return kinds;
  }

  void look_between(const VectorXd& from, const VectorXd& to) {
    const auto a = plane_.spectrum(from), b = plane_.spectrum(to);
    if (a && b && a->unstable() != b->unstable()) rates_cross(from, to, a->unstable());
  }

  void begin_at(const BalanceBoundary& b) {
    const VectorXd at = b.along_x ? plane_.place(b.value, grid_.own->y) : plane_.place(grid_.own->x, b.value);
    if (b.change == BalanceBoundary::Change::hopf) follow(CurveKind::hopf, at, {0.0, b.frequency * b.frequency, {}});
    if (b.change == BalanceBoundary::Change::zero) follow(CurveKind::zero, at);
    constexpr double rounding = 1e-9;  // elsewhere balance ends for want of room
    const auto margin = plane_.margin(at);
    if (b.change == BalanceBoundary::Change::existence && margin && std::fabs(*margin) < rounding)
      follow(CurveKind::existence, at);
  }

  void look(int column, int row, int next_column, int next_row) {
    const BalancePoint &a = grid_.points[grid_.at(column, row)], &b = grid_.points[grid_.at(next_column, next_row)];
    const VectorXd from = place(column, row), to = place(next_column, next_row);
    const bool has_a = std::isfinite(a.growth), has_b = std::isfinite(b.growth);
    if (has_a && has_b && a.unstable != b.unstable) return rates_cross(from, to, a.unstable);
    if ((a.kind == BalanceKind::none) != (b.kind == BalanceKind::none) && a.margin * b.margin < 0.0)
      follow(CurveKind::existence, between_signs(from, to, a.margin));
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
    if (nearest->imag() == 0.0) return follow(CurveKind::zero, other);
    follow(CurveKind::hopf, other, {0.0, std::norm(*nearest), {}});
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

  void follow(CurveKind kind, const VectorXd& at, const EigenPair& pair = {}) {
    if (is_known(kind, of_balance, at, std::sqrt(std::max(0.0, pair.product)))) return;
    BalanceCurve curve(plane_, kind, pair);
    if (curve.follow(at, stop_)) add_curve(kind, of_balance, curve);
  }
};

}  // namespace

bool ChartSearch::is_known(CurveKind kind, const std::string& of, const VectorXd& at, double frequency) const {
  // A curve's places are nearer to each other than CurveFollower::longest_step; it turns by less than 0.1 between two.
  constexpr double beside = 1e-3;
  for (const ChartCurve& curve : chart_.curves) {
    // Cycles may be born of one state and end in another.
    if (curve.kind != kind || (curve.of != of && !is_of_cycles(kind))) continue;
    for (std::size_t k = 1; k < curve.points.size(); ++k) {
      const CurvePoint &p = curve.points[k - 1], &q = curve.points[k];
      const VectorXd a = plane_.place(p.x, p.y), chord = plane_.place(q.x, q.y) - a, offset = at - a;
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

void ChartSearch::add_curve(CurveKind kind, const std::string& of, const FollowedCurve& curve) {
  ChartCurve found{kind, of, {}, curve.ends(), curve.error()};
  for (const CurvePlace& p : curve.places()) found.points.push_back(p.point);
  const double same = is_of_cycles(kind) ? 1e-6 : 1e-7;
  const auto met = [&](const SpecialPoint& point) {
    const VectorXd at = plane_.place(point.x, point.y);
    return std::any_of(chart_.specials.begin(), chart_.specials.end(), [&](const SpecialPoint& other) {
      const ChartCurve& its = chart_.curves[other.curve];
      return other.kind == point.kind && (is_of_cycles(its.kind) || its.of == of) &&
             (plane_.place(other.x, other.y) - at).norm() < same;
    });
  };
  chart_.curves.push_back(std::move(found));
  for (SpecialPoint special : curve.specials()) {
    special.curve = chart_.curves.size() - 1;
    if (!met(special)) chart_.specials.push_back(std::move(special));
  }
}

void add_curves(const PlaneStudies& plane, const StopFlag* stop, BifurcationChart& chart) {
  CurveSearch(plane, stop, chart).run();
}

void add_curves_between_boxes(const PlaneStudies& plane, const StopFlag* stop, BifurcationChart& chart) {
  CurveSearch(plane, stop, chart).run_between_boxes();
}

}  // namespace equipoise
