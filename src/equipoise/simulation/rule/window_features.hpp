// Features of a trajectory over windows of time, and whether they show it to be stationary.
//
// Short windows are compared with boxes around known motions; long windows, each twice as long as the one before, with
// each other. Both decide only after several windows agree, never by one threshold.
#pragma once

#include <array>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A lane's sums over half a short window.
struct WindowSums {
  double duration = 0.0;
  double r2_min = 0.0, r2_max = 0.0, r2_integral = 0.0;             ///< of r^2
  std::array<double, model::max_balls> turned{}, q_min{}, q_max{};  ///< change of phi_i; extremes of q_i
  double rotor_turned = 0.0, speed_min = 0.0, speed_max = 0.0;      ///< of psi, if the rotor is driven
};

Features features(const WindowSums& sums, int balls, bool interchangeable);

/// Whether two windows agree: in the largest and rms r to `sameness` of the largest (the smallest: twice that); in the
/// balls' mean rates and the extremes of all rates together to `sameness` of the largest rate; and in psi' to
/// `sameness` of its greatest size.
bool same_motion(const Features& a, const Features& b, int balls, double sameness);

/// Features as they would be at the middle of the part: row `trend` of `shifts` (OwnRotor::shifts) is subtracted.
/// Unchanged if there is no such row.
Features brought_back(const Features& f, int trend, const double* shifts, int balls);

/// Whether the features of a window lie inside, brought back by FeatureBox::trend if there are `shifts`.
bool inside(const FeatureBox& box, const Features& f, int balls, const double* shifts = nullptr);

/// A finite window of a torus or of chaos shows its extremes and means to a few percent.
inline constexpr double known_tolerance = 0.05;
/// The entry of `known` nearest to long-window features `f`; null if none is the same motion to `tolerance`. `shifts`:
/// of the rotor, or null; with shifts the result is also null if two attractors agree to known_tolerance, and a
/// motion with little vibration on this rotor is left out if balance is nearer to the window.
const KnownFeatures* nearest_known(const Features& f, const std::vector<KnownFeatures>& known, int balls,
                                   const double* shifts = nullptr, double tolerance = known_tolerance);

/// The same among motions of the very rotor that shows `f`. Those that are not chaotic must agree to `sameness`.
const KnownFeatures* nearest_met(const Features& f, const std::vector<KnownFeatures>& met, int balls, double sameness);

/// What a trajectory's windows have decided.
struct WindowConclusion {
  bool decided = false;
  int attractor = 0;  ///< 0 when decided: a stationary motion that the rule does not list
};

/// One trajectory's windows, fed with half windows: short windows overlap by one half.
class WindowTracker {
 public:
  /// `own`: the lane's own rotor, or null; it must outlive the windows.
  void begin(const ClassificationRule& rule, const OwnRotor* own = nullptr);
  /// Adds a finished half window. Decides if hits_needed short windows in a row lie in one box, or repeats_needed long
  /// ones repeat the one before (a chaotic transient matches once in 10^5) or show a known chaotic motion.
  WindowConclusion add(const WindowSums& half);
  /// So far: features of the last long window, range of its short ones, longest runs inside boxes.
  PilotRecord record() const;
  /// Time since the first window began.
  double elapsed() const { return elapsed_; }
  /// Mean psi' over the last long window. Before that since the first began; NaN before half a short one has ended.
  double mean_speed() const;
  /// The attractor at the horizon, by the last short windows or else by the last long one; 0 if neither recognises one.
  int attractor_at_end() const;
  /// The regular motion of the rule's list that a long trajectory has shown for its last fifth or more, although too
  /// late for long windows to repeat; 0 if there is none.
  int settled_at_end() const;
  /// Listed chaos whose means are those of the last long window; 0 if there is none. Whether the trajectory is chaotic
  /// is for the caller to find out.
  int chaos_at_end() const;

 private:
  // Whether a short window lies in the box and is not nearer to balance than to the box's motion.
  bool shows(const FeatureBox& box, const Features& f) const;
  // The attractor in whose box the last short windows lie, as many as the box needs; 0 if none.
  int attractor_now() const;
  WindowConclusion finish_long_window();
  // Whether this chaos (KnownFeatures::chaos) has yet to show that it lasts.
  bool may_end(int chaos) const;
  // The known motion with these long-window features, or null. If the rotor's own motions are known (OwnRotor::met),
  // the rule's, which may be a neighbour's, are not consulted.
  const KnownFeatures* known_by(const Features& f) const;
  // The listed chaos with the nearest means; null if none is near.
  const KnownFeatures* nearest_chaos(const Features& f) const;
  // The attractor if `known` is chaotic; else that of another rotor's similar chaos, if this one has lasted; 0 if none.
  int chaos_in(const Features& f, const KnownFeatures* known) const;

  const ClassificationRule* rule_ = nullptr;
  const OwnRotor* own_ = nullptr;
  double elapsed_ = 0.0, long_end_ = 0.0;
  int repeats_ = 0, chaotic_ = 0, chaotic_repeats_ = 0;
  bool has_half_ = false, fresh_ = true, fresh_range_ = true, has_previous_ = false;
  WindowSums half_, long_, previous_sums_;
  FeatureBox range_, previous_range_;
  Features previous_{};
  std::array<int, most_boxes> runs_{}, longest_{};
};

}  // namespace equipoise
