// Figures computed from sums.
#include "equipoise/columns/transient_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace equipoise {

namespace {
constexpr float unknown = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();

double root(double square) { return std::sqrt(std::max(square, 0.0)); }
}  // namespace

TransientRow transient_row(const TransientSettings& settings, const TransientSums& sums, bool lost,
                           const std::optional<MotionFigures>& end) {
  TransientRow row;
  if (lost) {
    for (const TransientFigure& figure : transient_figures) row.*figure.value = unknown;
    return row;
  }
  const TransientWindow& w = sums.window;
  const MotionFigures last = end ? *end
                                 : MotionFigures{root(w.peak), 0.0, root(w.force / w.length),
                                                 root(w.velocity / w.length), size_of(w.unbalance) / w.length};
  const double after_release = std::max(root(sums.free_peak), last.radial);
  row.peak_radial = static_cast<float>(std::max(root(sums.clamped_peak), after_release));
  row.peak_radial_after_release = static_cast<float>(after_release);
  row.peak_radial_at_end = static_cast<float>(last.radial);
  row.peak_force = static_cast<float>(std::max(root(sums.force_peak), last.peak_force));
  row.rms_force = static_cast<float>(last.rms_force);
  row.rms_velocity = static_cast<float>(last.rms_velocity);
  row.residual_unbalance = static_cast<float>(last.unbalance);
  // For good below a limit: the motion at the end is, and the trajectory was when last seen.
  const auto below = [&](double limit) { return last.radial <= limit && root(w.peak) <= limit; };
  row.time_above = below(settings.displacement) ? static_cast<float>(sums.time_above) : endless;
  row.settling_time = settings.watches_settling() && below(settings.settled)
                          ? static_cast<float>(std::max(0.0, sums.last_above - settings.release))
                          : endless;
  row.energy = settings.work == WorkSource::none ? unknown : static_cast<float>(sums.work.total());
  row.followed_until = static_cast<float>(sums.end);
  return row;
}

}  // namespace equipoise
