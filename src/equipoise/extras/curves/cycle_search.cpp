// Cycles: starts along Hopf curves, branches in parallel, and meanwhile one curve after the other.
#include "equipoise/extras/curves/curve_starts.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/extras/curves/cycle_curve.hpp"
#include "equipoise/extras/cycles/cycle_branch.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

struct CycleOrigin {
  CycleStart start;
  std::string of;
};

class CycleSearch : ChartSearch {
 public:
  CycleSearch(const PlaneStudies& plane, const RunOptions& run, BifurcationChart& chart)
      : ChartSearch(plane, run.stop, chart), run_(run) {}

  void run() {
    std::vector<CycleOrigin> origins;
    for (const ChartCurve& curve : chart_.curves)
      if (curve.kind == CurveKind::hopf) add_origins(curve, origins);
    std::vector<std::optional<std::vector<CycleCrossing>>> crossings(origins.size());
    std::atomic<std::size_t> begun = 0;
    std::size_t first = 0;  // whose curves are to be followed next
    bool following = false;
    std::mutex mutex;
    in_parallel(run_.threads, origins.size(), [&](std::size_t) {
      const std::size_t own = begun++;  // in their order: the first curves need not wait for the last branch
      CycleBranch branch;
      if (!is_set(stop_))
        branch = cycle_branch([&](const VectorXd& at) { return plane_.system(at); }, origins[own].start, stop_);
      std::unique_lock lock(mutex);
      crossings[own] = std::move(branch.crossings);
      if (following) return;
      following = true;
      for (; first < origins.size() && crossings[first]; ++first) {
        const std::vector<CycleCrossing> here = std::move(*crossings[first]);
        lock.unlock();
        for (const CycleCrossing& crossing : here)
          if (is_set(stop_))
            ++chart_.cycles_left;
          else
            follow(crossing, origins[first].of);
        if (run_.progress && !is_set(stop_)) run_.progress({first + 1, origins.size(), "cycles", {}});
        lock.lock();
      }
      following = false;
    });
  }

 private:
  VectorXd place_of(const CurvePoint& p) const { return plane_.place(p.x, p.y); }

  // At equal distances along the curve, and next to special points, where curves of cycles begin; then across it.
  void add_origins(const ChartCurve& curve, std::vector<CycleOrigin>& origins) const {
    constexpr double apart = 0.1;  // of the plane's sides
    constexpr double fewest = 8.0;
    constexpr double on_curve = 1e-3, beside[] = {-0.02, -0.005, 0.005, 0.02};
    std::vector<double> length{0.0};
    for (std::size_t k = 1; k < curve.points.size(); ++k)
      length.push_back(length.back() + (place_of(curve.points[k]) - place_of(curve.points[k - 1])).norm());
    const double count = std::max(fewest, std::floor(length.back() / apart));
    std::vector<double> starts;
    for (double n = 0.5; n < count; n += 1.0) starts.push_back(n / count * length.back());
    for (const SpecialPoint& special : chart_.specials) {
      if (special.kind != SpecialKind::double_hopf && special.kind != SpecialKind::zero_hopf &&
          special.kind != SpecialKind::fold_hopf && special.kind != SpecialKind::generalised_hopf)
        continue;
      const VectorXd at = plane_.place(special.x, special.y);
      const auto nearer = [&](const CurvePoint& p, const CurvePoint& q) {
        return (place_of(p) - at).norm() < (place_of(q) - at).norm();
      };
      const auto nearest = std::min_element(curve.points.begin(), curve.points.end(), nearer);
      if ((place_of(*nearest) - at).norm() > CurveFollower::longest_step + on_curve) continue;
      for (const double step : beside)
        starts.push_back(length[static_cast<std::size_t>(nearest - curve.points.begin())] + step);
    }
    std::set<std::size_t> places;
    for (const double at : starts)
      places.insert(static_cast<std::size_t>(std::lower_bound(length.begin(), length.end(), at) - length.begin()));
    for (const std::size_t k : places) add_origin(curve, k, origins);
  }
  void add_origin(const ChartCurve& curve, std::size_t k, std::vector<CycleOrigin>& origins) const {
    constexpr double slowest = 1e-3;  // a longer period than of a few thousand is not followed
    if (k == 0 || k + 1 >= curve.points.size()) return;
    const CurvePoint& p = curve.points[k];
    if (!(p.frequency > slowest) || (curve.of == of_balance && is_of_continuum(place_of(p)))) return;
    const VectorXd along = (place_of(curve.points[k + 1]) - place_of(curve.points[k - 1])).normalized();
    origins.push_back(
        {{place_of(p), Eigen::Vector2d(-along[1], along[0]),
          Eigen::Map<const VectorXd>(p.state.data(), static_cast<Eigen::Index>(p.state.size())), p.frequency},
         curve.of});
  }
  bool is_of_continuum(const VectorXd& at) const {
    const auto spectrum = plane_.spectrum(at);
    return !spectrum || spectrum->family;
  }

  void follow(const CycleCrossing& crossing, const std::string& of) {
    const auto system = plane_.system(crossing.near.at);
    if (!system) return;
    const CurveKind kind = crossing.change;
    if (is_known(kind, of, crossing.near.at, two_pi / crossing.near.shape.period)) return;
    CycleCurve curve(plane_, *system, crossing);
    if (!curve.follow_from(crossing, stop_, known(kind, of))) return;
    add_curve(kind, of, curve);
    ChartCurve& found = chart_.curves.back();
    if (found.ends[0] == CurveEnd::vanishes)
      if (const auto end = birth(kind, found.points.front())) found.points.insert(found.points.begin(), *end);
    if (found.ends[1] == CurveEnd::vanishes)
      if (const auto end = birth(kind, found.points.back())) found.points.push_back(*end);
  }

  // The point of a Hopf curve at which a cycle of size 0 is what the curve is about.
  std::optional<CurvePoint> birth(CurveKind kind, const CurvePoint& last) const {
    constexpr double beside = 1e-2, alike = 0.02;
    std::optional<CurvePoint> best;
    double least = beside;
    for (const SpecialPoint& p : chart_.specials) {
      const bool fits = kind == CurveKind::cycle_fold
                            ? p.kind == SpecialKind::generalised_hopf
                            : p.kind == SpecialKind::double_hopf || p.kind == SpecialKind::zero_hopf ||
                                  p.kind == SpecialKind::fold_hopf;
      const double distance = (plane_.place(p.x, p.y) - place_of(last)).norm();
      const auto swings_so = [&](double frequency) {
        return std::fabs(frequency - last.frequency) < alike * last.frequency;
      };
      if (!fits || distance >= least) continue;
      if (!swings_so(p.frequency) && !swings_so(p.second)) continue;
      least = distance;
      best = last;
      best->x = p.x;
      best->y = p.y;
      best->frequency = swings_so(p.frequency) ? p.frequency : p.second;
      best->swing = 0.0;
      best->state = p.state;
      best->rates.clear();
    }
    return best;
  }

  const RunOptions& run_;
};

}  // namespace

void add_cycles(const PlaneStudies& plane, const RunOptions& run, BifurcationChart& chart) {
  const auto system = plane.system(Eigen::Vector2d(0.5, 0.5));
  if (system && !system->smooth()) chart.no_cycles = "touching or sticking balls break them off";
  chart.cycle_bounds = {longest_turns, largest_cycle_multiplier, most_cycle_points};
  if (chart.no_cycles.empty()) CycleSearch(plane, run, chart).run();
}

}  // namespace equipoise
