// Figures computed from sums, and compared with every limit.
#include "equipoise/results/columns/transient_figures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/standards/hand_arm.hpp"

namespace equipoise {

namespace {
constexpr float unknown = std::numeric_limits<float>::quiet_NaN(), endless = std::numeric_limits<float>::infinity();

double root(double square) { return std::sqrt(std::max(square, 0.0)); }

// Whatever bearings stated one by one draw, each of them is known.
bool draws_other_supports(const Uncertainty& drawn) {
  if (drawn.physical && drawn.physical->find_path("rotor.tilt.bearings")) return false;
  return std::any_of(drawn.values.begin(), drawn.values.end(),
                     [](const UncertainValue& v) { return v.key.starts_with("rotor."); });
}
}  // namespace

WatchedShaft watched_shaft(const Study& study) {
  WatchedShaft shaft;
  if (study.bearings.empty()) return shaft;
  const auto [least, most] = std::minmax_element(study.bearings.begin(), study.bearings.end());
  shaft.places = {*least, *most};
  if (study.standards.standing_mass || draws_other_supports(study.uncertain)) return shaft;
  shaft.bearings = study.each_bearing();
  std::vector<model::Bearing>& each = shaft.bearings;
  std::sort(each.begin(), each.end(), [](const auto& a, const auto& b) { return a.at < b.at; });
  if (each.size() > 2) std::swap(each[1], each.back());  // the outermost two first
  return shaft;
}

bool weighs(const Study& study) { return study.parameters.gravity != 0.0; }
bool runs_up(const Study& study) { return study.speed.driven() || study.speed.profile != Profile::constant; }
bool has_directions(const Study& study) { return model::depends_on_rotor_angle(study.parameters); }

double hand_arm_factor(double speed, double frequency) {
  return speed > 0.0 ? standards::hand_arm_weighting(speed * frequency / two_pi) * speed : 0.0;
}

TransientRow transient_row(const TransientSettings& settings, const TransientSums& sums, bool lost,
                           const std::optional<MotionFigures>& end) {
  TransientRow row;
  if (lost) {
    for (const TransientFigure& figure : transient_figures) row.*figure.value = unknown;
    return row;
  }
  const TransientWindow& w = sums.window;
  const MotionFigures last = end ? *end
                                 : MotionFigures{root(w.peak),
                                                 0.0,
                                                 root(w.force / w.length),
                                                 root(w.velocity / w.length),
                                                 size_of(w.unbalance) / w.length,
                                                 0.0,
                                                 root(w.dynamic / w.length),
                                                 root(std::max(w.directions[0], w.directions[1]) / w.length)};
  const RadialPeak peak = larger(sums.clamped_peak, sums.free_peak);
  const double after_release = std::max(root(sums.free_peak.square), last.radial);
  row.peak_radial = static_cast<float>(std::max(root(sums.clamped_peak.square), after_release));
  const bool seen = last.radial < root(peak.square);
  row.peak_time = seen ? static_cast<float>(peak.time) : unknown;
  row.peak_speed = seen ? static_cast<float>(std::fabs(peak.speed)) : unknown;
  row.peak_radial_after_release = static_cast<float>(after_release);
  row.peak_radial_at_end = static_cast<float>(last.radial);
  row.peak_force = static_cast<float>(std::max(root(sums.force_peak), last.peak_force));
  row.rms_force = static_cast<float>(last.rms_force);
  row.rms_velocity = static_cast<float>(last.rms_velocity);
  row.peak_dynamic_force = static_cast<float>(std::max(root(sums.dynamic_peak), last.peak_dynamic));
  row.rms_dynamic_force = static_cast<float>(last.rms_dynamic);
  row.rms_velocity_one_direction = static_cast<float>(last.rms_one_direction);
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

LimitsOfStart limits_of_start(const Limits& limits, const TransientRow& row, double speed, double frequency) {
  LimitsOfStart of;
  of.at_end = !(limits.settled && row.peak_radial_at_end > *limits.settled);
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    const TransientLimit& l = transient_limits[k];
    const auto& limit = limits.*l.limit;
    if (!limit) continue;
    const auto beyond = [&](float TransientRow::*figure) {
      return !(row.*figure * (l.by_speed ? l.by_speed->of(speed, frequency) : 1.0) <= *limit);
    };
    of.exceeded[k] = beyond(l.value);
    of.exceeded_at_end[k] = beyond(l.end);
    of.at_end = of.at_end && !of.exceeded_at_end[k];
    of.on_the_way = of.on_the_way && (l.at_end || !of.exceeded[k]);
  }
  return of;
}

}  // namespace equipoise
