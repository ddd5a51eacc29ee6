// Continua of balanced states (three balls or more, or two alike balls without unbalance): which part of one attracts,
// and to which member a nearby state comes.
#pragma once

#include <array>
#include <optional>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/attractor.hpp"

namespace equipoise {

/// One member: the equilibrium or, with anisotropic supports, the fixed point of the map between sections. Gravity
/// leaves slow motion along the continuum, and so do anisotropic supports of an off-centre race. The member is then the
/// state on the section that the map moves only along the continuum. Matrices are in units of System::scale().
/// Deviations are split by the invariant subspaces of the linearised equations: d = along left d + range range^T (d -
/// along left d).
struct ContinuumMember {
  std::array<double, model::max_balls> phi{};  ///< ball angles of the balanced state
  Eigen::VectorXd centre;
  double rate = 0.0;  ///< largest real part across the continuum; negative: stable across
  Eigen::MatrixXd along,
      left;                ///< directions of the continuum, columns; their left eigenvectors, rows
  Eigen::MatrixXd range;   ///< orthonormal basis of the invariant subspace across
  Eigen::MatrixXd across;  ///< the linearised equations in it: d/dt, or the map minus one
  Eigen::MatrixXd form;    ///< P on that; V falls at least as e^(1.6 rate t) nearby, and is |s|^2 or more
  /// Scale of V: from member to member, terms of second order begin to matter in proportion to it.
  double unit = 0.0;
  Eigen::VectorXd creep;  ///< velocity along the continuum, as gravity leaves none of it at rest; size 0: none
};

/// The largest real part, without the `zeros` eigenvalues closest to zero. With a `section_period` the values are
/// multipliers over it, and the result is the rate of the largest, without those closest to one.
double slowest_of(const Eigen::VectorXcd& eigenvalues, Eigen::Index zeros, double section_period = 0.0);

/// A sample of a continuum: its stable part, with members.
struct ContinuumSample : ContinuumPart {
  bool attracts() const { return !members.empty(); }
  /// Stable members, the slowest first. If few or none of those drawn are stable, more were searched for.
  std::vector<std::array<double, model::max_balls>> members;
  std::vector<double> rates;  ///< of these members
  std::array<double, model::max_balls>
      typical{};  ///< median by rate of the stable ones; without any, the slowest to grow
};

class ContinuumOfEquilibria {
 public:
  /// For any system, except those with section `turn` and motors without torque. Balls pass each other on their way to
  /// balance, but members that a sample draws have room.
  explicit ContinuumOfEquilibria(const model::System& system);
  static bool is_of(const model::System& system) {
    return system.section() != model::Section::turn && !system.coasts();
  }

  /// The member at ball angles near `phi`. Empty if there is none, or if the linearisation has more zeros than the
  /// continuum explains. Without `form` if it is unstable across.
  std::optional<ContinuumMember> member(const double* phi) const;
  /// The member that the trajectory from `state` comes to, to second order in the distance: the deviation from it has
  /// no part along the continuum. With a stroboscopic section `state` must lie on it.
  std::optional<ContinuumMember> destination(const Eigen::VectorXd& state) const;

  /// V of a state about a stable member.
  double value(const ContinuumMember& member, const Eigen::VectorXd& state) const;
  /// The state with V = `value` in the direction of a vector of directions() numbers.
  Eigen::VectorXd state_at(const ContinuumMember& member, double value, const Eigen::VectorXd& direction) const;
  Eigen::Index directions() const { return scale_.size() - dimension_; }

  /// The level that `factor` gives a member.
  static double level(const ContinuumMember& member, double factor);
  /// Whether the state's destination attracts at `slowest_rate` (negative) or faster, and V lies below its level. Under
  /// gravity that must hold as far as the destination creeps in 20 000 time units. A slower destination at rest must
  /// also attract, and V must lie below the level that `slow_factor` gives it; 0: slower ones do not count.
  bool holds(const Eigen::VectorXd& state, double factor, double slowest_rate, double slow_factor = 0.0) const;

  /// Short once `stop` is set.
  ContinuumSample sample(const StopFlag* stop = nullptr) const;

 private:
  bool settle(ContinuumMember& member, const Eigen::VectorXd& offset = {}) const;
  bool is_astray(const ContinuumMember& member) const;
  bool shape(ContinuumMember& member) const;
  bool stays(ContinuumMember member, double slowest_rate) const;
  bool balance(double* phi) const { return model::project_to_balanced(system_, speed_, phi); }
  double rate_at(const double* phi) const;
  std::optional<std::array<double, model::max_balls>> moved(std::array<double, model::max_balls> phi,
                                                            const Eigen::VectorXd& along) const;

  Eigen::VectorXd deviation(const ContinuumMember& member, const Eigen::VectorXd& state) const;

  model::System system_, balanced_;  // as given; without gravity
  model::CentredTwin twin_;          // its balls balance at these angles, turned; they may collide too
  double speed_, section_period_;    // in balance; 0: nothing depends on the rotor's angle
  bool rests_;                       // members are at rest
  Eigen::Index dimension_;
  Eigen::VectorXd scale_;
};

/// The balanced state nearest to a state, refined as its system needs.
struct BalancedMember {
  Eigen::VectorXd state;
  std::variant<Equilibrium, PeriodicOrbit> refined;  ///< an orbit with a stroboscopic section
  double rate = -1.0;                                ///< of the slowest deviation across the continuum
  bool attracts = false;                             ///< in all directions across it
};

/// Empty if there is none. With a stroboscopic section also if none is within `reach` (in System::scale()) of exact
/// balance.
std::optional<BalancedMember> nearest_balanced(const model::System& system, const Eigen::VectorXd& state, double reach);

Motion describe(const model::System& system, const BalancedMember& member);

}  // namespace equipoise
