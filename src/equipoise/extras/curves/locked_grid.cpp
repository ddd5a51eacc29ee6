// States at the points, bisection between neighbours that differ, and connected regions.
#include "equipoise/extras/curves/curve_starts.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/curves/locked_states.hpp"
#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

constexpr std::size_t points_of_chunk = 64;  // milliseconds of work

class LockedSearch : ChartSearch {
 public:
  LockedSearch(const PlaneStudies& plane, int threads, const StopFlag* stop, BifurcationChart& chart)
      : ChartSearch(plane, stop, chart),
        threads_(threads),
        middle_(plane.at(grid_.x.centre(grid_.x.pixels / 2), grid_.y.centre(grid_.y.pixels / 2)).system()) {}

  void run() {
    chart_.no_locked = locked_states_lack(middle_);
    if (chart_.no_locked.empty()) kinds_ = locked_kinds(middle_.parameters());
    for (const LockedKind& kind : kinds_) {
      symmetries_.emplace_back(middle_, kind);
      chart_.locked.push_back(kind.name);
    }
    look_at_points();
    if (!kinds_.empty())
      look_at_neighbours([&](int column, int row, int next_column, int next_row) {
        look_between(column, row, next_column, next_row);
      });
    if (!is_set(stop_)) add_regions(patterns_, pattern_of_, chart_);
  }

 private:
  std::vector<BalanceSpectrum> points_of(const model::System& system, std::size_t kind) const {
    std::vector<BalanceSpectrum> found;
    for (const VectorXd& state : locked_states(system, kinds_[kind]))
      found.push_back(locked_spectrum(system, symmetries_[kind], state));
    return found;
  }
  std::vector<BalanceSpectrum> points_at(const VectorXd& at, std::size_t kind) const {
    const auto system = plane_.system(at);
    return system ? points_of(*system, kind) : std::vector<BalanceSpectrum>();
  }

  // What exists at each point: of each kind the number of states, then each one's unstable eigenvalues.
  void look_at_points() {
    const std::size_t count = grid_.points.size();
    pattern_of_.assign(count, 0);
    std::map<RegionPattern, int> numbers;
    std::vector<RegionPattern> found(std::min<std::size_t>(count, 1024 * points_of_chunk));
    for (std::size_t begin = 0; begin < count && !is_set(stop_); begin += found.size()) {
      const std::size_t end = std::min(count, begin + found.size());
      in_parallel(threads_, (end - begin + points_of_chunk - 1) / points_of_chunk, [&](std::size_t chunk) {
        const std::size_t first = begin + chunk * points_of_chunk, last = std::min(end, first + points_of_chunk);
        for (std::size_t k = first; k < last && !is_set(stop_); ++k) found[k - begin] = pattern_at(k);
      });
      for (std::size_t k = begin; k < end; ++k) {
        const auto [place, fresh] = numbers.try_emplace(found[k - begin], static_cast<int>(patterns_.size()));
        if (fresh) patterns_.push_back(found[k - begin]);
        pattern_of_[k] = place->second;
      }
    }
  }

  RegionPattern pattern_at(std::size_t k) const {
    RegionPattern pattern{grid_.points[k].kind, {}};
    const auto columns = static_cast<std::size_t>(grid_.x.pixels);
    const double x = grid_.x.centre(static_cast<int>(k % columns)), y = grid_.y.centre(static_cast<int>(k / columns));
    const model::System system = plane_.at(x, y).system();
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      pattern.unstable.emplace_back();
      for (const BalanceSpectrum& point : points_of(system, kind)) pattern.unstable.back().push_back(point.unstable());
    }
    return pattern;
  }

  void look_between(int column, int row, int next_column, int next_row) {
    const int a = pattern_of_[grid_.at(column, row)], b = pattern_of_[grid_.at(next_column, next_row)];
    if (a == b) return;
    const VectorXd from = place(column, row), to = place(next_column, next_row);
    for (std::size_t kind = 0; kind < kinds_.size(); ++kind) {
      const auto &here = patterns_[static_cast<std::size_t>(a)].unstable[kind],
                 &there = patterns_[static_cast<std::size_t>(b)].unstable[kind];
      if (here.size() != there.size())
        merging(from, to, here.size(), kind);
      else if (here != there)
        crossings(from, to, kind);
    }
  }

  // Between two places of which one has more states: those that merge first.
  void merging(const VectorXd& from, const VectorXd& to, std::size_t count, std::size_t kind) {
    VectorXd same = from, other = to;
    for (int k = 0; k < 40; ++k) {
      const VectorXd middle = 0.5 * (same + other);
      (points_at(middle, kind).size() == count ? same : other) = middle;
    }
    auto more = points_at(same, kind), less = points_at(other, kind);
    VectorXd at = same;
    if (less.size() > more.size()) more.swap(less), at = other;
    std::size_t first = more.size();
    double least = INFINITY;
    for (std::size_t k = 1; k < more.size(); ++k)
      if (const double apart = distance(kind, more[k - 1].state, more[k].state); apart < least)
        least = apart, first = k;
    if (first < more.size()) follow(CurveKind::fold, kind, at, 0.5 * (more[first - 1].state + more[first].state), {});
  }

  double distance(std::size_t kind, const VectorXd& a, const VectorXd& b) const {
    const LockedSymmetry& s = symmetries_[kind];
    return (s.reduced(a) - s.reduced(b)).cwiseQuotient(s.scale()).norm();
  }

  // Each state is followed from one place to the other.
  void crossings(const VectorXd& from, const VectorXd& to, std::size_t kind) {
    const auto begin = points_at(from, kind), end = points_at(to, kind);
    for (std::size_t k = 0; k < begin.size() && k < end.size(); ++k)
      if (begin[k].unstable() != end[k].unstable()) crossing(from, to, begin[k].unstable(), k, kind);
  }

  void crossing(const VectorXd& from, const VectorXd& to, int unstable, std::size_t number, std::size_t kind) {
    VectorXd same = from, other = to;
    std::optional<BalanceSpectrum> found;
    for (int k = 0; k < 36; ++k) {
      const VectorXd middle = 0.5 * (same + other);
      auto points = points_at(middle, kind);
      if (number >= points.size()) return;
      found.emplace(std::move(points[number]));
      (found->unstable() == unstable ? same : other) = middle;
    }
    const auto nearest = std::min_element(found->rates.begin(), found->rates.end(), [](const auto& p, const auto& q) {
      return std::fabs(p.real()) < std::fabs(q.real());
    });
    constexpr double turns = 1e-6;  // of two equal real rates rounding makes a pair, slower than this
    if (std::fabs(nearest->imag()) > turns)
      follow(CurveKind::hopf, kind, same, found->state, {0.0, std::norm(*nearest), {}});
    else if (!symmetries_[kind].partings().empty())
      follow(CurveKind::pitchfork, kind, same, found->state, {});
  }

  void follow(CurveKind curve_kind, std::size_t kind, const VectorXd& at, const VectorXd& state,
              const EigenPair& pair) {
    const std::string& of = kinds_[kind].name;
    if (is_known(curve_kind, of, at, std::sqrt(std::max(0.0, pair.product)))) return;
    LockedCurve curve(plane_, curve_kind, kinds_[kind], middle_, pair);
    // A motor's states may be missed next to a fold: the curve that is found may then be further away.
    if (curve.follow_from(at, state, stop_, known(curve_kind, of))) add_curve(curve_kind, of, curve);
  }

  int threads_;
  model::System middle_;  // of one of the plane's studies
  std::vector<LockedKind> kinds_;
  std::vector<LockedSymmetry> symmetries_;
  std::vector<RegionPattern> patterns_;
  std::vector<int> pattern_of_;  // by point of the grid
};

}  // namespace

void add_locked_states(const PlaneStudies& plane, int threads, const StopFlag* stop, BifurcationChart& chart) {
  LockedSearch(plane, threads, stop, chart).run();
}

}  // namespace equipoise
