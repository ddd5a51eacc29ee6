// Features of a trajectory over windows of time, and what they say about stationarity.
//
// Short windows are compared with boxes around motions already known; long windows, each twice as long as the one
// before, with each other. Both judge a motion by what it does for as long as it does it, never by one threshold.
#pragma once

#include "equipoise/attractors/decision_rule.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// What a lane gathers over one short window.
struct WindowSums {
  double duration = 0.0;
  double r2_min = 0.0, r2_max = 0.0, r2_integral = 0.0;             ///< of r^2
  std::array<double, model::max_balls> turned{}, q_min{}, q_max{};  ///< change of phi_i; extremes of q_i
};

Features features(const WindowSums& sums, int balls, bool interchangeable);

/// Two windows agree in the largest and rms r, to `sameness` of the largest (the smallest: twice that), and in the
/// balls' mean rates and the extremes of all rates together, to `sameness` of the largest rate.
bool same_motion(const Features& a, const Features& b, int balls, double sameness);

enum class WindowVerdict {
  open,
  known,       ///< in one box for hits_needed short windows in a row
  stationary,  ///< repeats_needed long windows in a row repeated the one before (a chaotic transient matches once in
               ///< 10^5)
};

/// One trajectory's windows.
class WindowTracker {
 public:
  void begin(const DecisionRule& rule);
  /// Takes in a finished short window.
  WindowVerdict add(const WindowSums& sums);
  /// Features of the last long window, and the range of its short windows' features (after `stationary`).
  const Features& long_features() const { return previous_; }
  const FeatureBox& range() const { return range_; }

 private:
  WindowVerdict finish_long_window();

  const DecisionRule* rule_ = nullptr;
  double elapsed_ = 0.0, long_end_ = 0.0;
  int box_ = -1, hits_ = 0, repeats_ = 0;
  bool fresh_ = true, has_previous_ = false;
  WindowSums long_;
  FeatureBox range_;
  Features previous_{};
};

}  // namespace equipoise
