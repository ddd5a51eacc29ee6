// Trapping regions that test one state at a time, where half a short window ends: around stable equilibria, periodic
// motions without an angle as phase, and motions that differ from rotor to rotor of a family.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// A level set of a function V of states, 0 on a motion of a system with section `none` and falling on the way to it.
///
/// Places along the motion, equally spaced in time, each with a form P of deviations. V of a state is the least d^T P d
/// over the places next to it, with d its deviation from the motion there. An equilibrium has one place. In
/// System::scale() V is the square of the distance or more.
///
/// For a part of a family, places are polynomials of the coordinates, fitted to the motions of some rotors. Rotors that
/// lack the motion, or barely have it, are also known. A rotor that is closer to one of these than any rotor with the
/// motion gets an infinite V.
class PathRegion {
 public:
  /// Around a motion of a smooth system with section `none`. Null if there is no region: neither an equilibrium nor
  /// periodic, too slow an approach, too many exchange images, Floquet vectors that double precision cannot separate,
  /// or a failed integration. `rotors`: of a family's part, those nearest to the one with `motion` first; also null if
  /// few of them have it.
  static std::shared_ptr<PathRegion> around(const model::System& system, const Motion& motion, int attractor,
                                            const std::vector<const OwnRotor*>& rotors, const StopFlag* stop,
                                            NotePage* notes = nullptr);

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
  /// A state on `level` next to place `which` (modulo their number) of the motion.
  Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                 const OwnRotor* own = nullptr) const;
  /// Whether the rotor has the motion, as far as known.
  bool holds_for(const OwnRotor& own) const;

 private:
  struct Place {
    Eigen::VectorXd flow, bend;  // in time: first and second derivative there
    Eigen::VectorXd phase;       // phase . d: how much later than this place a state is
    Eigen::MatrixXd form;        // P
  };
  // The motion of one rotor.
  struct There {
    const OwnRotor* own = nullptr;
    Eigen::VectorXd rest;
    PeriodicOrbit orbit;
    double rate = 0.0;
    Eigen::VectorXd places;                // one after the other
    std::vector<Eigen::VectorXd> between;  // half way between places
  };
  template <class Bytes, Like<There> T>
  friend void members(Bytes& b, T& t) {
    b(t.rest, t.orbit, t.rate, t.places, t.between);
  }
  // A rotor without the motion, and its distance from the nearest rotor that has it.
  struct Lacking {
    std::vector<double> coordinates;
    double square_to_nearest = 0.0;
  };

  PathRegion(const model::System& system, int attractor)
      : attractor_(attractor), balls_(system.balls()), inverse_scale_(system.scale().cwiseInverse()) {}

  bool describe_rest(const model::System& system, const Motion& motion);
  bool describe_orbit(const model::System& system, const Motion& motion);
  bool follow_rotors(const Motion& motion, const std::vector<const OwnRotor*>& rotors, const StopFlag* stop,
                     NotePage* notes);
  bool fit(const std::vector<There>& all);
  // The largest V of these motions' states, all of which are held.
  double largest_miss(const std::vector<There>& all);
  // Of one that was read: whether it can be this rotor's.
  bool fits(const model::System& system, const There& there) const;
  // The rotor's motion by Newton's method from a neighbour's.
  std::optional<There> found(const OwnRotor& own, const There& neighbour, const StopFlag* stop) const;
  // The states at the places; empty if that fails. Also sets `between`.
  Eigen::VectorXd places_of(const model::System& system, There& there) const;
  Eigen::VectorXd away(const Eigen::VectorXd& state, const Eigen::VectorXd& from) const;
  void lay_out();
  Eigen::VectorXd terms(const OwnRotor* own) const;
  // V of a state whose balls are in their places, not outside may_hold().
  double value_in_place(const double* state, const OwnRotor* own) const;
  // Whether a state, its balls in their places, may lie within the level, by everything except ball angles.
  bool may_hold(const double* state) const;
  // Widens low_, high_ and the bounds of r to contain a state on the motion.
  void hold(const Eigen::VectorXd& state);

  int attractor_, balls_;
  double level_ = 0.0, floor_ = 0.0;
  double between_ = 0.0;  // largest distance along the motion between kept states
  double rate_ = 0.0;     // at which states end in the motion, negative
  Eigen::VectorXd inverse_scale_;
  std::vector<Eigen::VectorXi> places_;  // of a state's components, for each exchange of alike balls
  Eigen::VectorXd low_, high_;           // of everything on the motion
  double r2_low_ = 1e300, r2_high_ = 0.0;
  std::vector<Place> along_;
  Eigen::MatrixXd positions_;     // a column for each term of the coordinates; place after place
  int degree_ = 0;                // of these polynomials
  std::vector<Lacking> lacking_;  // in a family
  double half_ = 0.0;             // a state up to this much earlier or later lies next to a place; 0 for an equilibrium
  std::vector<double> table_;     // all that value_in_place() reads, for all places
};

/// Sets the region's level by trials. False if no level passes. `near`: as in highest_good_level().
bool validate(const std::shared_ptr<PathRegion>& region, const LevelLadder& ladder, const TrialSettings& settings,
              double near = 0.0);

/// The trapping region, with its level found by trials. Null if there is none. `own`: the rotor that has the motion, if
/// trials have their own; `near`: as in highest_good_level().
std::shared_ptr<const PathRegion> path_region(const model::System& system, const Motion& motion, int attractor,
                                              const TrialSettings& settings, const OwnRotor* own, double near = 0.0);

/// Makes `rule` test these in place of earlier ones.
void set_window_regions(ClassificationRule& rule, const std::vector<std::shared_ptr<const PathRegion>>& regions);

}  // namespace equipoise
