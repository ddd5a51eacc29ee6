// What starts do long after their decision: the same trajectories as in an ensemble, followed without any rule that
// decides.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::audit {

/// Extremes over a window of time of the distance from the rotor's rest position.
struct RadiusRange {
  double low = 0.0, mean = 0.0, high = 0.0;
};

/// One start. The first of two windows begins halfway to the second.
struct LateMotion {
  bool followed = false;  ///< false if its balls are never released: nothing else is known then
  bool lost = false;      ///< diverged or failed
  RadiusRange before, after;
  std::array<double, model::max_balls> turned{};  ///< turns of each ball from the first window's start to the second's
                                                  ///< end
  std::array<double, model::max_balls> swing{};   ///< largest less smallest ball angle within the second window
  std::array<double, model::max_balls> rate{};    ///< mean phi' from the first window's start to the second's end
  std::array<double, model::max_balls> rate_early{},
      rate_late{};     ///< the same over the first half of that and the rest
  double speed = 0.0;  ///< mean psi' over the same time
};

/// When to sample, in time since the final speed was reached (for a machine: since the drive's last piece began).
struct LookTimes {
  double first = 0.0, second = 0.0;  ///< starts of the two windows
  double length = 0.0;               ///< of each
  double span() const { return second + length - first; }
};

/// Start `number` of a study with uncertain values, with the rotor that it draws.
OwnRotorStart own_rotor_start(const StudyFamily& family, const Study& study, std::uint64_t number);

/// Starts first .. first + count - 1 of `study`, on `threads` threads; with uncertain values each with its own rotor.
std::vector<LateMotion> follow_late(const Study& study, std::uint64_t first, std::size_t count, const LookTimes& times,
                                    int threads);

/// Length of a window that covers many turns of everything that turns at the study's speeds.
double window_length(const Study& study);

}  // namespace equipoise::audit
