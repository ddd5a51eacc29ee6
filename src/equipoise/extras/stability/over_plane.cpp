// The points in chunks on all threads, then the way from the study's own point to the boundaries.
#include "equipoise/extras/stability/over_plane.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/extras/stability/balance_at.hpp"
#include "equipoise/extras/stability/plane_studies.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

// Points that a thread takes at once, at most: milliseconds of work, seconds where multipliers are integrated.
constexpr std::size_t points_at_once = 64;

// From the own value of one parameter to the end of the plane, the other parameter held.
class WayToBoundary {
 public:
  WayToBoundary(const PlaneStudies& studies, const OwnPoint& own, bool along_x)
      : studies_(studies), own_(own), along_x_(along_x), looks_(own.point.by_multipliers ? 64 : 256) {}

  /// Empty if it was stopped.
  std::optional<BalanceBoundary> look(double end, bool upwards, int threads, const RunOptions& settings) const {
    const BalanceBoundary none{along_x_, upwards, BalanceBoundary::Change::none, end, 0.0};
    const double begin = along_x_ ? own_.x : own_.y;
    const auto value = [&](std::size_t k) {
      return begin + (end - begin) * static_cast<double>(k) / static_cast<double>(looks_);
    };
    const std::size_t at_once = 2 * static_cast<std::size_t>(threads);
    std::vector<char> changed(at_once);
    for (std::size_t first = 1; first <= looks_; first += at_once) {
      const std::size_t count = std::min(at_once, looks_ + 1 - first);
      in_parallel(threads, count, [&](std::size_t k) {
        changed[k] = is_set(settings.stop) || at(value(first + k)).kind != own_.point.kind;
      });
      if (is_set(settings.stop)) return std::nullopt;
      for (std::size_t k = first; k < first + count; ++k)
        if (changed[k - first]) return between(value(k - 1), value(k), merging * (end - begin), none, settings.stop);
      if (settings.progress && own_.point.by_multipliers)
        settings.progress({first + count - 1, looks_, "steps to the next change", {}});
    }
    return none;
  }

 private:
  static constexpr double merging = 1e-6;  // so near, as a share of the way

  BalancePoint at(double value) const {
    return balance_at(along_x_ ? studies_.at(value, own_.y) : studies_.at(own_.x, value));
  }

  // Bisection, to the last digits that rates have.
  std::optional<BalanceBoundary> between(double same, double other, double little, BalanceBoundary boundary,
                                         const StopFlag* stop) const {
    using Change = BalanceBoundary::Change;
    for (int k = 0; k < 48; ++k) {
      if (is_set(stop)) return std::nullopt;
      const double middle = 0.5 * (same + other);
      (at(middle).kind == own_.point.kind ? same : other) = middle;
    }
    boundary.value = 0.5 * (same + other);
    const BalancePoint before = at(same), after = at(other);
    const BalancePoint& known = std::isfinite(before.growth) ? before : after;
    boundary.frequency = known.swings() ? known.frequency : 0.0;
    const auto either = [&](BalanceKind kind) { return before.kind == kind || after.kind == kind; };
    // Where two states merge an eigenvalue is 0, to rounding, before they are gone.
    const auto gone = [&] {
      return !known.swings() && std::fabs(known.growth) < merging && at(other + little).kind == BalanceKind::none;
    };
    boundary.change = either(BalanceKind::none) || gone() ? Change::existence
                      : either(BalanceKind::unknown)      ? Change::lost
                      : std::fabs(known.growth) > merging ? Change::jump
                      : known.swings()                    ? Change::hopf
                                                          : Change::zero;
    return boundary;
  }

  const PlaneStudies& studies_;
  const OwnPoint& own_;
  const bool along_x_;
  const std::size_t looks_;  // to the plane's end; each takes a thousand times longer where multipliers are integrated
};

// Stopped, it has not all boundaries, and the plane is not complete.
std::optional<OwnPoint> own_point(const PlaneStudies& studies, const RunOptions& settings, StabilityPlane& plane) {
  const auto x = studies.own_x(), y = studies.own_y();
  if (!x || !y) return std::nullopt;
  OwnPoint own{
      *x, *y, balance_at(studies.at(*x, *y), settings.stop), continuum_at(studies.at(*x, *y), settings.stop), {}};
  const auto inside = [](const SliceAxis& axis, double value) { return axis.low <= value && value <= axis.high; };
  if (!inside(plane.x, *x) || !inside(plane.y, *y)) return own;
  for (const bool along_x : {true, false}) {
    const SliceAxis& axis = along_x ? plane.x : plane.y;
    const double value = along_x ? *x : *y;
    // The plane's end, or the last point before it where no study can have that value.
    const auto end = [&](double edge, int pixel) {
      return (along_x ? studies.valid(edge, *y) : studies.valid(*x, edge)) ? edge : axis.centre(pixel);
    };
    const double first = end(axis.low, 0), last = end(axis.high, axis.pixels - 1);
    const WayToBoundary way(studies, own, along_x);
    for (const auto& [edge, upwards] : {std::pair{first, false}, {last, true}}) {
      if (upwards ? !(value < edge) : !(value > edge)) continue;
      const auto boundary = way.look(edge, upwards, plane.threads, settings);
      if (!boundary) {
        plane.complete = false;
        return own;
      }
      own.boundaries.push_back(*boundary);
    }
  }
  return own;
}

StabilityPlane computed(const PlaneStudies& studies, const RunOptions& settings) {
  const RunClock clock;
  StabilityPlane plane;
  plane.study = studies.study();
  plane.x = studies.x();
  plane.y = studies.y();
  note_machine(plane, settings);
  const std::size_t points = static_cast<std::size_t>(plane.x.pixels) * static_cast<std::size_t>(plane.y.pixels);
  plane.points.resize(points);
  std::mutex telling;
  std::size_t told = 0;
  const std::size_t at_once =
      std::clamp<std::size_t>(points / (8 * static_cast<std::size_t>(plane.threads)), 1, points_at_once);
  in_parallel(plane.threads, (points + at_once - 1) / at_once, [&](std::size_t chunk) {
    const std::size_t first = chunk * at_once, last = std::min(points, first + at_once);
    for (std::size_t k = first; k < last; ++k) {
      if (is_set(settings.stop)) return;
      const auto columns = static_cast<std::size_t>(plane.x.pixels);
      const double x = plane.x.centre(static_cast<int>(k % columns)), y = plane.y.centre(static_cast<int>(k / columns));
      plane.points[k] = balance_at(studies.at(x, y), settings.stop);
    }
    const std::lock_guard lock(telling);
    told += last - first;
    if (settings.progress) settings.progress({told, points, "points", {}});
  });
  plane.complete = plane.count(BalanceKind::not_computed) == 0;
  if (plane.complete) plane.own = own_point(studies, settings, plane);
  plane.took(clock.time());
  return plane;
}

}  // namespace

StabilityPlane stability(const Study& given, const StabilitySettings& settings) {
  check_has_balls(given);
  reject_if_lacking(given, model::ResultKind::maps);
  const PlaneStudies studies(with_medians(given), settings.x, settings.y);
  StabilityPlane plane;
  plane.study = studies.study();
  plane.x = settings.x;
  plane.y = settings.y;
  if (!settings.output.empty()) check_stability_file(settings.output, plane);
  plane = stability(studies, settings);
  if (!settings.output.empty()) write_stability_file(settings.output, plane);
  return plane;
}

StabilityPlane stability(const PlaneStudies& studies, const RunOptions& options) {
  return long_call(options, [&](const RunOptions& o) { return computed(studies, o); });
}

}  // namespace equipoise
