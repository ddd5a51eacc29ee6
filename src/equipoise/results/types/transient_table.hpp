// Sums that the time loop gathers of every trajectory; figures are made of them
// (results/columns/transient_figures.hpp).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "equipoise/machine/mechanics/forced_vibration.hpp"

namespace equipoise {

/// How the drive's work is computed: of a prescribed speed by an energy balance; of a motor from torque and speed.
enum class WorkSource { none, balance, motor };

/// Where a tilting rotor is watched. Figures are those of the worse place.
struct WatchedShaft {
  /// The outermost of its bearings along the shaft, 0 without bearings. For a straight shaft's places between two, none
  /// moves further or faster than both.
  std::array<double, 2> places{};
  /// The bearings if they are all its supports and forces are reported for each, those at `places` first, at most
  /// model::most_bearings; empty: of all supports together.
  std::vector<model::Bearing> bearings{};
};

/// What is watched on every trajectory. Dimensionless.
struct TransientSettings {
  /// Radial displacement whose exceedance is timed; infinite: none.
  double displacement = std::numeric_limits<double>::infinity();
  /// Radial displacement below which a rotor has settled; 0: settling is not watched.
  double settled = 0.0;
  double release = 0.0;  ///< study time at which the balls are released
  /// Length of time windows once the outcome is known: many turns of the rotor, several slow turns of balls about it.
  double window = 16.0;
  WorkSource work = WorkSource::none;  ///< of the drive
  WatchedShaft shaft{};                ///< of a tilting rotor
  /// Supports differ or weight acts: velocities in X and Y and forces without the weight are gathered separately.
  bool by_direction = true;

  bool watches_settling() const { return settled > 0.0; }
};

/// The unbalance of rotor and balls in the rotating frame, x and y; of a tilting rotor those of two planes
/// (model::PlaneUnbalance). What turns with the rotor is its mean: balls that hang or circulate add nothing.
using TurningUnbalance = std::array<double, 4>;
/// Its size; of two planes the larger.
inline double size_of(const TurningUnbalance& u) { return std::fmax(std::hypot(u[0], u[1]), std::hypot(u[2], u[3])); }

/// Sums over a window of time. r: from where the rotor rests under its weight.
struct TransientWindow {
  double length = 0.0;
  double peak = 0.0;                   ///< largest r^2
  double force = 0.0;                  ///< integral of |f|^2
  double velocity = 0.0;               ///< integral of u^2 + v^2
  TurningUnbalance unbalance{};        ///< its integral
  double dynamic = 0.0;                ///< of |f - f at rest|^2
  std::array<double, 2> directions{};  ///< of the squared velocities in X and in Y
};

/// A window and what follows on it.
inline TransientWindow last_windows(const TransientWindow& before, const TransientWindow& last) {
  TransientWindow both{before.length + last.length,
                       before.peak > last.peak ? before.peak : last.peak,
                       before.force + last.force,
                       before.velocity + last.velocity,
                       before.unbalance,
                       before.dynamic + last.dynamic,
                       before.directions};
  for (std::size_t d = 0; d < 2; ++d) both.directions[d] += last.directions[d];
  for (std::size_t k = 0; k < both.unbalance.size(); ++k) both.unbalance[k] += last.unbalance[k];
  return both;
}

/// Of two places over the same time, what the worse one has.
inline TransientWindow worse_of(const TransientWindow& a, const TransientWindow& b) {
  return {a.length,
          std::fmax(a.peak, b.peak),
          std::fmax(a.force, b.force),
          std::fmax(a.velocity, b.velocity),
          a.unbalance,
          std::fmax(a.dynamic, b.dynamic),
          {std::fmax(a.directions[0], b.directions[0]), std::fmax(a.directions[1], b.directions[1])}};
}

using model::MotionFigures;

/// What is known of where a decided trajectory goes.
struct KnownEnd {
  std::optional<MotionFigures> figures;  ///< none: they have to be measured
  double wait = 0.0;                     ///< without figures: time after which the rest of the transient is small
};

/// Whether at most `allowed` is left of an approach: differences that shrink from d1 to d2, one after the other, leave
/// d2^2/(d1 - d2) to come, or less if they die out faster than 1/t.
inline bool has_nearly_arrived(double d1, double d2, double allowed) {
  const double change = std::fabs(d2);
  return change * change <= allowed * (std::fabs(d1) - change);
}

/// Whether a trajectory whose outcome is known may end with the window `last`: its figures change no more. `before`:
/// the windows at the last two powers of two below `windows`, the later first; `windows`: how many there were since the
/// decision, with `last`; `peak`: largest r^2 from release on.
///
/// With known figures, once r stays for a window in the nearer half of the way from the motion's own largest r to every
/// limit above that, since a deviation that dies out does not double again, and a tenth of that way below the peak.
///
/// Else the first, second and fourth windows are compared, then the second, fourth and eighth, and so on. From doubled
/// time to doubled time the last two must agree to 2 % in peak and in root mean square velocity, and what is left of
/// the peak's approach must be below 5e-4, a tenth of what three digits show. A departure from an unstable motion grows
/// instead. Of chaos 32 windows are enough; figures that go on rising or falling are followed for up to 1024.
inline bool seen_enough(const TransientSettings& settings, const KnownEnd& end,
                        const std::array<TransientWindow, 2>& before, const TransientWindow& last, int windows,
                        double peak) {
  if (end.figures) {
    const double own = end.figures->radial;
    const auto below = [&](double limit, double part) {
      const double level = own + part * (limit - own);
      return last.peak <= level * level;
    };
    const bool timed = std::isfinite(settings.displacement);
    if (own < settings.settled && !below(settings.settled, 0.5)) return false;
    if (timed && own < settings.displacement && !below(settings.displacement, 0.5)) return false;
    // The largest r of a torus or of chaos is known to about 2 %: less is no excess.
    return peak <= own * own * 1.04 || below(std::sqrt(peak), 0.9);
  }
  constexpr int fewest_windows = 4, most_windows = 32, most_creeping = 1024;
  const bool doubled = (windows & (windows - 1)) == 0;
  if (windows * settings.window < end.wait || windows < fewest_windows || !doubled) return false;
  constexpr double sameness = 0.04, digits = 1e-3, sampling = 1e-4;  // of squares; peaks are found to `sampling`
  const auto mean = [](const TransientWindow& w) { return w.velocity / w.length; };
  const double d1 = before[0].peak - before[1].peak, d2 = last.peak - before[0].peak;
  const double v1 = mean(before[0]) - mean(before[1]), v2 = mean(last) - mean(before[0]);
  const double change = std::fabs(d2);
  const bool done = change <= sampling * last.peak || has_nearly_arrived(d1, d2, digits * last.peak);
  if (done && change <= sameness * last.peak && std::fabs(v2) <= sameness * mean(last)) return true;
  const bool creeps = d1 * d2 > 0.0 && v1 * v2 > 0.0;
  return windows >= (creeps ? most_creeping : most_windows);
}

/// The work of a drive. Energy taken back by braking is lost: the sum of each piece counts if it is positive.
struct DriveWork {
  double before = 0.0;  ///< of the pieces that are over
  double piece = 0.0;   ///< of the one under way, less what was taken back
  double stored = 0.0;  ///< energy when last seen, where work follows from a balance
  double power = 0.0;   ///< then: what is summed over time
  bool begun = false;

  void end_piece() {
    before = total();
    piece = 0.0;
  }
  double total() const { return before + (piece > 0.0 ? piece : 0.0); }
};

/// The largest r^2 so far, and the study time and psi' at which it was reached.
struct RadialPeak {
  double square = 0.0, time = 0.0, speed = 0.0;
};
inline RadialPeak larger(const RadialPeak& a, const RadialPeak& b) { return b.square > a.square ? b : a; }

/// Of one trajectory so far. Squares, so that the time loop takes no root.
struct TransientSums {
  double end = 0.0;           ///< study time up to which all this holds
  RadialPeak clamped_peak;    ///< before release
  RadialPeak free_peak;       ///< from release on
  double force_peak = 0.0;    ///< largest |f|^2
  double dynamic_peak = 0.0;  ///< largest |f - f at rest|^2
  double time_above = 0.0;    ///< with r > settings.displacement, from t = 0
  double last_above = 0.0;    ///< study time at which r > settings.settled held last, from release on; else 0
  TransientWindow window;     ///< the last one, or the last two, up to `end`
  DriveWork work;             ///< up to `end`, or to when the outcome was known
};

/// The sums of a task's trajectories, by place, handed on from one task to the next.
struct TransientTable {
  TransientSettings settings;
  std::vector<TransientSums> rows;
  std::vector<KnownEnd> ends;  ///< by the attractor's identifier; nothing is known of what is not there
  /// Of trajectories with rotors of their own, whose units may differ: a row's settings in place of those; else empty.
  std::vector<TransientSettings> own{};

  const TransientSettings& settings_of(std::size_t row) const { return own.empty() ? settings : own[row]; }

  /// The rows at these places, and where they go back to.
  TransientTable part(const std::vector<std::size_t>& places) const {
    TransientTable part{settings, {}, ends};
    for (const std::size_t i : places) {
      part.rows.push_back(rows[i]);
      if (!own.empty()) part.own.push_back(own[i]);
    }
    return part;
  }
  void put_back(const std::vector<std::size_t>& places, const TransientTable& part) {
    for (std::size_t k = 0; k < places.size(); ++k) rows[places[k]] = part.rows[k];
  }

  const KnownEnd& end_of(int attractor) const {
    static const KnownEnd unknown;
    const bool listed = attractor > 0 && static_cast<std::size_t>(attractor) < ends.size();
    return listed ? ends[static_cast<std::size_t>(attractor)] : unknown;
  }
};

}  // namespace equipoise
