// Features of a trajectory over windows of time, and what they say about stationarity.
//
// Short windows are compared with boxes around motions already known; long windows, each twice as long as the one
// before, with each other. Both judge a motion by what it does for as long as it does it, never by one threshold.
#pragma once

#include <array>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// What a lane gathers over half a short window.
struct WindowSums {
  double duration = 0.0;
  double r2_min = 0.0, r2_max = 0.0, r2_integral = 0.0;             ///< of r^2
  std::array<double, model::max_balls> turned{}, q_min{}, q_max{};  ///< change of phi_i; extremes of q_i
  double rotor_turned = 0.0, speed_min = 0.0, speed_max = 0.0;      ///< of psi, if the rotor is driven
};

Features features(const WindowSums& sums, int balls, bool interchangeable);

/// Two windows agree in the largest and rms r, to `sameness` of the largest (the smallest: twice that), and in the
/// balls' mean rates and the extremes of all rates together, to `sameness` of the largest rate; and in psi', to
/// `sameness` of its greatest size.
bool same_motion(const Features& a, const Features& b, int balls, double sameness);

/// The entry of `known` nearest to long-window features `f`; null if none is the same motion.
const KnownFeatures* nearest_known(const Features& f, const std::vector<KnownFeatures>& known, int balls);

/// What a trajectory's windows say.
struct WindowVerdict {
  bool decided = false;
  int attractor = 0;  ///< 0 and decided: a stationary motion that the rule does not list
};

/// One trajectory's windows. Fed with half windows: short windows overlap by one half.
class WindowTracker {
 public:
  void begin(const DecisionRule& rule);
  /// Takes in a finished half window. Decided when as many short windows in a row as its box asks for lie in one box,
  /// or when repeats_needed long windows in a row repeat the one before (a chaotic transient matches once in 10^5) or
  /// show a known chaotic motion.
  WindowVerdict add(const WindowSums& half);
  /// What is known so far: features of the last long window, range of its short ones, longest runs inside boxes.
  PilotRecord record() const;
  /// Mean psi' over the last long window; before one has ended, since the first began; NaN before half a short one has.
  double mean_speed() const;
  /// What to say at the end of all time: the attractor that the last short windows tell, or else the last long one; 0
  /// if neither does.
  int attractor_at_end() const;

 private:
  // The attractor in whose box the last short windows lie, as many as it asks for; 0 if none.
  int attractor_now() const;
  WindowVerdict finish_long_window();

  const DecisionRule* rule_ = nullptr;
  double elapsed_ = 0.0, long_end_ = 0.0;
  int repeats_ = 0, chaotic_ = 0, chaotic_repeats_ = 0;
  bool has_half_ = false, fresh_ = true, fresh_range_ = true, has_previous_ = false;
  WindowSums half_, long_;
  FeatureBox range_, previous_range_;
  Features previous_{};
  std::array<int, most_boxes> runs_{}, longest_{};
};

}  // namespace equipoise
