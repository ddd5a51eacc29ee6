// SharedRegions that are asked about one state at a time, where half a short window of time ends.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/trapping_regions/trials.hpp"

namespace equipoise {

/// A level set of a function V of states that is 0 on a motion of a system of section none and falls on the way to it.
class WindowRegion {
 public:
  virtual ~WindowRegion() = default;

  int attractor() const { return attractor_; }
  double level() const { return level_; }
  void set_level(double level) { level_ = level; }
  /// V of states on the motion, as computed, is no higher.
  double floor() const { return floor_; }
  /// How long V takes to sink from `value` to the level at the motion's own rate; 0 where that is not known.
  double time_to_level(double value) const;
  /// Makes the bounds at which lanes are asked hold this trapping region.
  void widen(WindowRegions& bounds) const;

  /// V, the least over the places that like balls may take; infinite where nothing on the motion is near or where the
  /// state plainly lies above the level. `own`: the state's own rotor, null if it has none.
  virtual double value(const double* state, const OwnRotor* own) const = 0;
  /// A state on `level` beside place `which` (modulo how many there are) of the motion.
  virtual Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                         const OwnRotor* own) const = 0;

 protected:
  WindowRegion(const model::System& system, int attractor)
      : attractor_(attractor), balls_(system.balls()), inverse_scale_(system.scale().cwiseInverse()) {}

  // Takes a state on the motion into low_, high_ and the bounds of r.
  void hold(const Eigen::VectorXd& state);
  // Whether a state, its balls in their places, may lie within the level: all but its balls' angles.
  bool may_hold(const double* state) const;

  int attractor_, balls_;
  double level_ = 0.0, floor_ = 0.0;
  double between_ = 0.0;  // how far the motion goes from one of the states that were held to the next, at most
  double rate_ = 0.0;     // at which states come to the motion, negative
  Eigen::VectorXd inverse_scale_;
  std::vector<Eigen::VectorXi> places_;  // of a state's components, for each exchange of like balls that is looked at

 private:
  Eigen::VectorXd low_, high_;  // of everything on the motion
  double r2_low_ = 1e300, r2_high_ = 0.0;
};

/// How a level is looked for.
struct WindowTries {
  double highest = 1.0;
  int halvings = 24;
  double come_close = 1e-3;  ///< the share of the level that the first part of the tries has to come to
};

/// Sets the trapping region's level by tries, as those of other trapping regions are. False if there is none. `near`:
/// as of highest_good_level().
bool validate(const std::shared_ptr<WindowRegion>& region, const WindowTries& tries, const TrialSettings& settings,
              double near = 0.0);

/// Makes `rule` ask these in place of those it asked before.
void set_window_regions(ClassificationRule& rule, const std::vector<std::shared_ptr<const WindowRegion>>& regions);

}  // namespace equipoise
