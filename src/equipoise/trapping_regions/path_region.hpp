// SharedRegions around stable equilibria and periodic motions of which no angle tells the phase, and around those that
// every rotor of a family has elsewhere.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/batch/own_rotor.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"
#include "equipoise/running/search_log.hpp"
#include "equipoise/trapping_regions/window_region.hpp"

namespace equipoise {

/// Places along the motion, equally spaced in time, each with the form P of deviations there: V of a state is the least
/// d^T P d over the places that it lies beside, d being its deviation from the motion there. An equilibrium is one
/// place. In System::scale() V is the square of the distance or more.
///
/// Of a family's part the places are polynomials of what differs between rotors, fitted to the motions of some of them.
/// Of a rotor nearer to one that lacks the motion, or barely has it, than any is that has it, V is infinite.
class PathRegion final : public WindowRegion {
 public:
  /// Of a motion of a smooth system of section none. Null where there is none: neither an equilibrium nor periodic, too
  /// slow an approach, too many exchange images, Floquet vectors that double precision cannot separate, a failed
  /// integration. `rotors`: of a family's part, the nearest to the one that has `motion` first; null, too, if few of
  /// them have it.
  static std::shared_ptr<PathRegion> around(const model::System& system, const Motion& motion, int attractor,
                                            const std::vector<const OwnRotor*>& rotors, const StopFlag* stop,
                                            NotePage* notes = nullptr);

  double value(const double* state, const OwnRotor* own) const override;
  Eigen::VectorXd state_on_level(std::size_t which, double level, const Eigen::VectorXd& direction,
                                 const OwnRotor* own) const override;
  /// Whether the rotor has the motion, as far as is known.
  bool holds_for(const OwnRotor& own) const;

 private:
  struct Place {
    Eigen::VectorXd flow, bend;  // in what time it passes there: first and second derivative
    Eigen::VectorXd phase;       // phase . d is how much later than here a state is
    Eigen::MatrixXd form;        // P
  };
  // The motion of one rotor.
  struct There {
    const OwnRotor* own = nullptr;
    Eigen::VectorXd rest;
    PeriodicOrbit orbit;
    double rate = 0.0;
    Eigen::VectorXd places;                // one after the other
    std::vector<Eigen::VectorXd> between;  // half way from one to the next
  };
  template <class Bytes, Like<There> T>
  friend void members(Bytes& b, T& t) {
    b(t.rest, t.orbit, t.rate, t.places, t.between);
  }
  struct Tried {
    const OwnRotor* own;
    bool has = false;
  };
  // A rotor without the motion, and how far from it the nearest is that has it.
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
  // The largest V of these, whose states it holds from now on.
  double largest_miss(const std::vector<There>& all);
  // As Newton's method finds it from a neighbour's.
  std::optional<There> found(const OwnRotor& own, const There& neighbour, const StopFlag* stop) const;
  // At the places; empty if that fails. Fills in what is between.
  Eigen::VectorXd places_of(const model::System& system, There& there) const;
  Eigen::VectorXd away(const Eigen::VectorXd& state, const Eigen::VectorXd& from) const;
  void lay_out();
  Eigen::VectorXd terms(const OwnRotor* own) const;
  double value_in_place(const double* state, const Eigen::VectorXd& terms, const OwnRotor* own) const;

  std::vector<Place> along_;
  Eigen::MatrixXd positions_;     // a column a term of the rotor's coordinates; place after place
  int degree_ = 0;                // of these
  std::vector<Lacking> lacking_;  // of a family
  double half_ = 0.0;             // a state this much earlier or later lies beside a place; 0 of an equilibrium
  std::vector<double> table_;     // of all places: what value_in_place() reads
};

/// The trapping region, its level found by tries. Null if there is none. `own`: the rotor that has the motion, if tries
/// have rotors of their own; `near`: as of highest_good_level().
std::shared_ptr<const PathRegion> path_region(const model::System& system, const Motion& motion, int attractor,
                                              const TrialSettings& settings, const OwnRotor* own, double near = 0.0);

}  // namespace equipoise
