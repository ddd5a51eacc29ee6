// Balance of a machine: its balanced states in the last piece of its drive, their linear stability, and when a
// trajectory has come to one.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/free_machine.hpp"

namespace equipoise {

/// Linear behaviour around one rest state, along continua left out.
struct LinearBalance {
  double rate = 0.0;    ///< of the slowest decay, > 0; or minus the growth rate
  bool stable() const;  ///< decays, and not merely by rounding
};

/// The balanced states of a machine whose race is centred and on which gravity does not act: there balance is exact,
/// x = y = 0, at the speed where no torque is needed. Other machines have none of this kind: exists() is false.
class MachineBalance {
 public:
  MachineBalance(const model::Parameters& p, const model::DrivePiece& last);

  bool exists() const { return exists_; }
  /// Why not.
  const std::string& reason() const { return reason_; }
  const model::FreeMachine& machine() const { return machine_; }
  const model::BalancedStates& states() const { return states_; }
  /// Directions along which a balanced state may be moved without any force: in the continuum of three balls or more,
  /// and in speed if no motor holds it.
  int free_directions() const;

  /// The balanced state next to a machine's state z (model/machine.hpp).
  std::optional<Eigen::VectorXd> nearest(const double* z) const;
  /// Stability of a balanced state in all directions but the free ones. With anisotropic supports by Floquet's theory.
  LinearBalance linearised(const Eigen::VectorXd& balanced) const;
  /// Distance of z from `balanced` in balls' angles; lengths in units of all unbalances together.
  double distance(const double* z, const Eigen::VectorXd& balanced) const;
  /// Whether the same angles balance stably at the speed that the machine has now.
  bool stable_now(const double* z, const Eigen::VectorXd& balanced) const;
  /// Whether a level set of a Lyapunov function of the linearisation around `balanced`, four times as high as the one
  /// that z lies on, is one that the whole equations leave nowhere: on a sample of its surface the function falls.
  /// False with anisotropic supports, and where balls might touch on the way.
  bool holds(const double* z, const Eigen::VectorXd& balanced) const;

 private:
  bool may_touch(const double* z, const Eigen::VectorXd& balanced) const;

  model::FreeMachine machine_;
  model::BalancedStates states_;
  bool exists_ = false;
  std::string reason_;
};

/// Slowest decay of the linear system dy/dt = A y but for `free` directions in which nothing happens.
LinearBalance linear_balance(const Eigen::MatrixXd& a, int free);

/// A rest state of an isotropic machine on which gravity does not act near y: Newton's method with the least change,
/// `free` smallest singular values left out. Empty if there is none within `reach` (angles; lengths as above).
std::optional<Eigen::VectorXd> rest_state(const model::FreeMachine& machine, const Eigen::VectorXd& y, double reach);

/// Follows one trajectory's way to balance. All tests are about what it does, at whichever times it is looked at.
class BalanceApproach {
 public:
  explicit BalanceApproach(const MachineBalance& balance) : balance_(balance) {}

  enum class Verdict {
    none,
    held,     ///< in a level set that the equations do not leave, around a stable balanced state
    arriving  ///< within a thousandth of a stable balanced state, and has been nearing it as linear theory promises
  };
  Verdict look(double t, const double* z);
  /// Distance from balance when last looked at, infinite where there is none.
  double distance() const { return distance_; }
  /// Next to a balanced state that is not stable.
  bool unstable_here() const { return unstable_; }

 private:
  void begin(double t, const Eigen::VectorXd& balanced);

  const MachineBalance& balance_;
  Eigen::VectorXd reference_;
  LinearBalance linear_;
  double first_time_ = 0.0, first_distance_ = 0.0, distance_ = 1e300, tried_ = 1e300;
  bool near_ = false, unstable_ = false;
};

}  // namespace equipoise
