// Trapping regions around stable equilibria, around periodic motions without an angle as phase, and around motions that
// differ from rotor to rotor of a family.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/classification/trapping_regions/window_region.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"

namespace equipoise {

/// Places along the motion, equally spaced in time, each with a form P of deviations. V of a state is the least d^T P d
/// over the places beside it, with d its deviation from the motion there. An equilibrium has one place. In
/// System::scale() V is the square of the distance or more.
///
/// For a part of a family, places are polynomials of the coordinates, fitted to the motions of some rotors. Rotors that
/// lack the motion, or barely have it, are known too. A rotor closer to one of them than any that has the motion gets
/// an infinite V.
class PathRegion final : public WindowRegion {
 public:
  /// Around a motion of a smooth system with section `none`. Null if there is no region: neither an equilibrium nor
  /// periodic, too slow an approach, too many exchange images, Floquet vectors that double precision cannot separate,
  /// or a failed integration. `rotors`: of a family's part, those nearest to the one with `motion` first; null, too, if
  /// few of them have it.
  static std::shared_ptr<PathRegion> around(const model::System& system, const Motion& motion, int attractor,
                                            const std::vector<const OwnRotor*>& rotors, const StopFlag* stop,
                                            NotePage* notes = nullptr);

  Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                 const OwnRotor* own) const override;
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

  using WindowRegion::WindowRegion;
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
  double value_in_place(const double* state, const OwnRotor* own) const override;

  std::vector<Place> along_;
  Eigen::MatrixXd positions_;     // a column for each term of the coordinates; place after place
  int degree_ = 0;                // of these polynomials
  std::vector<Lacking> lacking_;  // in a family
  double half_ = 0.0;             // a state up to this much earlier or later lies beside a place; 0 for an equilibrium
  std::vector<double> table_;     // all that value_in_place() reads, for all places
};

/// The trapping region, with its level found by trials. Null if there is none. `own`: the rotor that has the motion, if
/// trials have their own; `near`: as in highest_good_level().
std::shared_ptr<const PathRegion> path_region(const model::System& system, const Motion& motion, int attractor,
                                              const TrialSettings& settings, const OwnRotor* own, double near = 0.0);

}  // namespace equipoise
