// Continua of balanced states (three balls or more, or two equal balls without unbalance): which part of one attracts,
// and which of its members a state near by comes to.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/mechanics/balanced_state.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/types/attractor.hpp"

namespace equipoise {

/// One member: the equilibrium, or of anisotropic supports the fixed point of the stroboscopic map. Gravity leaves
/// slow motion along the continuum, and so do unequal supports of a race off its centre: the member is then the state
/// at a strobe that the map moves along it only. Matrices in units of System::scale(). Deviations are split by the
/// invariant subspaces of the linearised equations: d = along left d + range range^T (d - along left d).
struct ContinuumMember {
  std::array<double, model::max_balls> phi{};  ///< ball angles of the balanced state
  Eigen::VectorXd centre;
  double rate = 0.0;  ///< largest real part across the continuum; stable across if negative
  Eigen::MatrixXd along,
      left;                ///< the continuum's own directions, columns; left eigenvectors that belong to them, rows
  Eigen::MatrixXd range;   ///< orthonormal basis of the invariant subspace across
  Eigen::MatrixXd across;  ///< the linearised equations in it: d/dt, or of the map less one
  Eigen::MatrixXd form;    ///< P on that; V falls at least as e^(1.6 rate t) near by, and is |s|^2 or more
  /// Of V. Where terms of second order begin to matter goes like this from one member to another.
  double unit = 0.0;
  Eigen::VectorXd creep;  ///< velocity along the continuum (size 0: none): what gravity leaves of it is not at rest
};

/// A part of a continuum with its members.
struct ContinuumSurvey : ContinuumPart {
  bool attracts() const { return !members.empty(); }
  /// Stable ones, the slowest first. Where few or none of those drawn are stable, more were sought.
  std::vector<std::array<double, model::max_balls>> members;
  std::vector<double> rates;  ///< theirs
  std::array<double, model::max_balls>
      typical{};  ///< of the stable ones the median by rate, of none the slowest to grow
};

class ContinuumOfEquilibria {
 public:
  /// Of any system but of sections turn and of motors without torque. Balls pass each other on their way to balance,
  /// but members that a survey draws have room.
  explicit ContinuumOfEquilibria(const model::System& system);
  static bool is_of(const model::System& system) {
    return system.section() != model::Section::turn && !system.coasts();
  }

  /// The member at ball angles near `phi`. Empty where there is none or the linearisation has more zeros than the
  /// continuum explains. Without `form` if it is unstable across.
  std::optional<ContinuumMember> member(const double* phi) const;
  /// The member that the trajectory from `state` comes to, to second order in the distance: deviations from it have no
  /// part along the continuum. With anisotropic supports or gravity `state` is one at a strobe.
  std::optional<ContinuumMember> destination(const Eigen::VectorXd& state) const;

  /// V of a state about a stable member.
  double value(const ContinuumMember& member, const Eigen::VectorXd& state) const;
  /// The state with V = `value` in the direction of a vector of directions() numbers.
  Eigen::VectorXd state_at(const ContinuumMember& member, double value, const Eigen::VectorXd& direction) const;
  Eigen::Index directions() const { return scale_.size() - dimension_; }

  /// The level that `factor` gives a member.
  static double level(const ContinuumMember& member, double factor);
  /// The state's destination approaches at `slowest_rate` (negative) or faster, and V lies below its level. Under
  /// gravity that holds all along the way that the destination creeps in 20 000 units of time.
  bool holds(const Eigen::VectorXd& state, double factor, double slowest_rate) const;

  /// Short once `stop` is set.
  ContinuumSurvey survey(const StopFlag* stop = nullptr) const;

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
  model::CentredTwin twin_;          // whose balls balance at these angles but for a turn; they collide if those do
  double speed_, section_period_;    // in balance; 0: nothing depends on the rotor's angle
  bool rests_;                       // members are at rest
  Eigen::Index dimension_;
  Eigen::VectorXd scale_;
};

}  // namespace equipoise
