// Trapping regions that test one state at a time, where half a short window ends.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A level set of a function V of states, 0 on a motion of a system with section `none` and falling on the way to it.
class WindowRegion {
 public:
  virtual ~WindowRegion() = default;

  int attractor() const { return attractor_; }
  double level() const { return level_; }
  void set_level(double level) { level_ = level; }
  /// The highest V of states on the motion, as computed.
  double floor() const { return floor_; }
  /// How long V takes to fall from `value` to the level at the motion's own rate; 0 if unknown.
  double time_to_level(double value) const;
  /// Widens the bounds within which lanes test, so that they contain this region.
  void widen(WindowRegions& bounds) const;

  /// V, the least over the places that alike balls may take. Infinite if nothing on the motion is near, or the state is
  /// well above the level. `own`: the state's own rotor, or null.
  double value(const double* state, const OwnRotor* own = nullptr) const;
  /// A state on `level` beside place `which` (modulo their number) of the motion.
  virtual Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                         const OwnRotor* own = nullptr) const = 0;

 protected:
  WindowRegion(const model::System& system, int attractor)
      : attractor_(attractor), balls_(system.balls()), inverse_scale_(system.scale().cwiseInverse()) {}

  // V of a state whose balls are in their places, not outside may_hold().
  virtual double value_in_place(const double* state, const OwnRotor* own) const = 0;
  // Widens low_, high_ and the bounds of r to contain a state on the motion.
  void hold(const Eigen::VectorXd& state);

  int attractor_, balls_;
  double level_ = 0.0, floor_ = 0.0;
  double between_ = 0.0;  // largest distance along the motion between kept states
  double rate_ = 0.0;     // at which states come to the motion, negative
  Eigen::VectorXd inverse_scale_;
  std::vector<Eigen::VectorXi> places_;  // of a state's components, for each exchange of alike balls

 private:
  // Whether a state, its balls in their places, may lie within the level, by everything except ball angles.
  bool may_hold(const double* state) const;

  Eigen::VectorXd low_, high_;  // of everything on the motion
  double r2_low_ = 1e300, r2_high_ = 0.0;
};

/// Sets the region's level by trials. False if no level passes. `far_share`: the share of the level that the first
/// part of trials must come to; `near`: as in highest_good_level().
bool validate(const std::shared_ptr<WindowRegion>& region, const LevelLadder& ladder, double far_share,
              const TrialSettings& settings, double near = 0.0);

/// The trapping region around an attracting torus of a smooth system with section `none`: the distance of a state from
/// a cloud of states on the torus. Trials find its level. Null if there is none. `near`: as in highest_good_level().
std::shared_ptr<const WindowRegion> torus_region(const model::System& system, const Motion& motion, int attractor,
                                                 const TrialSettings& settings, double near = 0.0);

/// Makes `rule` test these in place of earlier ones.
void set_window_regions(ClassificationRule& rule, const std::vector<std::shared_ptr<const WindowRegion>>& regions);

}  // namespace equipoise
