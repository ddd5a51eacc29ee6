// What starts do long after they have been decided: the very same trajectories as in an ensemble, followed without any
// rule that decides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "equipoise/rotor_family/study_family.hpp"
#include "equipoise/spin_up/own_starts.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise::audit {

/// Extremes over a window of time, of the distance from where the rotor would rest.
struct RadiusRange {
  double low = 0.0, mean = 0.0, high = 0.0;
};

/// One start. Two windows: the first begins halfway to the second.
struct LateMotion {
  bool followed = false;  ///< false if its balls are never let go: nothing else is known then
  bool lost = false;      ///< diverged or failed
  RadiusRange before, after;
  std::array<double, model::max_balls> turned{};  ///< of each ball from the first window's begin to the second's end
  std::array<double, model::max_balls> swing{};   ///< largest less smallest ball angle within the second window
  std::array<double, model::max_balls> rate{};    ///< mean phi' from the first window's begin to the second's end
  std::array<double, model::max_balls> rate_early{},
      rate_late{};     ///< the same over the first half of that and the rest
  double speed = 0.0;  ///< mean psi' over the same time
};

/// When to look, in time from when the final speed is reached (a machine: from the drive's last piece).
struct LookTimes {
  double first = 0.0, second = 0.0;  ///< begins of the two windows
  double length = 0.0;               ///< of each
  double span() const { return second + length - first; }
};

/// Start `number` of a study with uncertain values, and the rotor that it draws.
OwnStart own_start(const StudyFamily& family, const Study& study, std::uint64_t number);

/// Starts first .. first + count - 1 of `study`, on `threads` threads; of one with uncertain values each with its own
/// rotor.
std::vector<LateMotion> follow_late(const Study& study, std::uint64_t first, std::size_t count, const LookTimes& times,
                                    int threads);

/// A window that holds many turns of whatever turns at the study's speeds.
double window_length(const Study& study);

}  // namespace equipoise::audit
