// Features of a trajectory over windows of time, and what they say about stationarity.
//
// Short windows are compared with boxes around motions already known; long windows, each twice as long as the one
// before, with each other. Both judge a motion by what it does for as long as it does it, never by one threshold.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/types/fate.hpp"

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

/// Features of a rotor's motion as the middle's would be: row `trend` of `shifts` (OwnRotor::shifts) taken off. As they
/// are where there is no such row.
Features brought_back(const Features& f, int trend, const double* shifts, int balls);

/// Whether the features of a window lie inside.
bool inside(const FeatureBox& box, const Features& f, int balls);

/// A finite window of a torus or of chaos shows its extremes and means to a few percent.
inline constexpr double known_tolerance = 0.05;
/// The entry of `known` nearest to long-window features `f`; null if none is the same motion, to `tolerance`.
/// `shifts`: of the rotor that shows them, or null; of such null also where two attractors agree to known_tolerance.
const KnownFeatures* nearest_known(const Features& f, const std::vector<KnownFeatures>& known, int balls,
                                   const double* shifts = nullptr, double tolerance = known_tolerance);

/// The same among motions of the very rotor that shows `f`. A regular one has to agree to `sameness`.
const KnownFeatures* nearest_met(const Features& f, const std::vector<KnownFeatures>& met, int balls, double sameness);

/// What a trajectory's windows say.
struct WindowVerdict {
  bool decided = false;
  int attractor = 0;  ///< 0 and decided: a stationary motion that the rule does not list
};

/// One trajectory's windows. Fed with half windows: short windows overlap by one half.
class WindowTracker {
 public:
  /// `own`: the rotor's own, or null; it outlives the windows.
  void begin(const DecisionRule& rule, const OwnRotor* own = nullptr);
  /// Takes in a finished half window. Decided when as many short windows in a row as its box asks for lie in one box,
  /// or when repeats_needed long windows in a row repeat the one before (a chaotic transient matches once in 10^5) or
  /// show a known chaotic motion.
  WindowVerdict add(const WindowSums& half);
  /// What is known so far: features of the last long window, range of its short ones, longest runs inside boxes.
  PilotRecord record() const;
  /// Time since the first window began.
  double elapsed() const { return elapsed_; }
  /// The largest r over the last window, short or long; NaN before one has ended.
  double radius() const { return radius_; }
  /// Mean psi' over the last long window; before one has ended, since the first began; NaN before half a short one has.
  double mean_speed() const;
  /// What to say at the end of all time: the attractor that the last short windows tell, or else the last long one; 0
  /// if neither does.
  int attractor_at_end() const;

 private:
  // The attractor in whose box the last short windows lie, as many as it asks for; 0 if none.
  int attractor_now() const;
  WindowVerdict finish_long_window();
  // Whether this chaos (KnownFeatures::chaos) has yet to show that it lasts.
  bool may_end(int chaos) const;
  // What long-window features show; null if nothing known. Where the rotor's own motions are known (OwnRotor::met), the
  // rule's, which may be a neighbour's, are not asked.
  const KnownFeatures* known_by(const Features& f) const;
  // The chaotic motion among these; or one of another rotor, if what they show has lasted; 0 if none.
  int chaos_in(const Features& f, const KnownFeatures* known) const;

  const DecisionRule* rule_ = nullptr;
  const OwnRotor* own_ = nullptr;
  double elapsed_ = 0.0, long_end_ = 0.0, radius_ = std::numeric_limits<double>::quiet_NaN();
  int repeats_ = 0, chaotic_ = 0, chaotic_repeats_ = 0;
  bool has_half_ = false, fresh_ = true, fresh_range_ = true, has_previous_ = false;
  WindowSums half_, long_;
  FeatureBox range_, previous_range_;
  Features previous_{};
  std::array<int, most_boxes> runs_{}, longest_{};
};

}  // namespace equipoise
