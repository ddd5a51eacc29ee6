// The equations of motion of a study as a first-order system, for other integrators and analyses.
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The quantities of a Trajectory at one time: an InitialState (psi, x, y, x_dot, y_dot, phi, phi_dot in the rotating
/// frame) and the further ones of a driven rotor.
struct MotionState : InitialState {
  double psi_dot = 0.0;
  double speed_error_integral = 0.0;  ///< if a speed control has one
};

/// dy/dt = f(t, y) for a whole study: spin-up, balls held and released, motor or prescribed speed. Time in 1/omega_c,
/// everything else as in docs/explanation/equations.md and machine/model/parameters.hpp.
///
/// State y: the `dimension()` numbers that variables() names (machine/model/state_layout.hpp). It includes psi and
/// psi_dot if a motor drives the rotor, and speed_error_integral if the motor's control has one.
///
/// Time is cut into pieces on which f is smooth. An integrator must end a step where a piece ends, pass the state
/// through cross(), and begin again. Functions without a piece number use the later piece at a breakpoint. f has one
/// more corner where a motor's torque reaches its limit (speed.torque.limit).
///
/// If a driven rotor's speed releases the balls, the pieces are those with the balls held. The zero of
/// release_distance() is the release, and released_at() has the equations from then on. Thread-safe.
class StudyEquations {
 public:
  /// Throws InputError for invalid studies, uncertain values, and contact or dry friction: only simulate() has events.
  explicit StudyEquations(const Study& study);
  StudyEquations(const StudyEquations&);
  StudyEquations& operator=(const StudyEquations&);
  ~StudyEquations();

  const Study& study() const;
  int dimension() const;
  const std::vector<model::StateVariable>& variables() const;

  struct Piece {
    double begin = 0.0, end = std::numeric_limits<double>::infinity();
    bool held = false;  ///< the balls are clamped: phi_i stay, phi_dot_i = 0
  };
  /// Contiguous from t = 0; the last has no end.
  const std::vector<Piece>& pieces() const;
  /// Number of the piece at t; at a breakpoint the later one.
  std::size_t piece_at(double t) const;
  /// Ends of all pieces but the last, in order.
  std::vector<double> breakpoints() const;
  /// When the balls are released; 0: free from the start; infinite if a speed decides.
  double release_time() const;
  std::optional<double> release_speed() const;
  /// psi_dot beyond release_speed(), in the direction of approach. Its first zero from below releases the balls. Throws
  /// InputError if there is no such speed.
  double release_distance(const double* y) const;
  /// The same study with the balls released at `t`; only for a study that releases at a speed.
  StudyEquations released_at(double t) const;

  /// The state at t = 0, of [initial] or of another start. phi_dot is 0 for held balls.
  std::vector<double> initial_state() const;
  std::vector<double> initial_state(const InitialState& start) const;

  /// dy/dt into `dy`.
  void rhs(double t, const double* y, double* dy) const { rhs(piece_at(t), t, y, dy); }
  void rhs(std::size_t piece, double t, const double* y, double* dy) const;
  /// d(dy/dt)/dy, exact (dual numbers), row-major: matrix[i * dimension() + k] = d(dy_i/dt)/dy_k.
  void jacobian(double t, const double* y, double* matrix) const { jacobian(piece_at(t), t, y, matrix); }
  void jacobian(std::size_t piece, double t, const double* y, double* matrix) const;
  /// From the end of a piece into the next, in place: psi' may jump (law "published"), and u and v with it.
  void cross(std::size_t piece, double* y) const;

  /// Mechanical energy, in M R^2 omega_c^2: model::energy().
  double energy(double t, const double* y) const { return energy(piece_at(t), t, y); }
  double energy(std::size_t piece, double t, const double* y) const;
  /// The powers that change it: dE/dt = drive - supports - balls.
  model::Powers powers(double t, const double* y) const { return powers(piece_at(t), t, y); }
  model::Powers powers(std::size_t piece, double t, const double* y) const;

  /// The state as in a trajectory, and back. At a prescribed speed psi and psi_dot follow from t and are not read.
  MotionState motion(double t, const double* y) const { return motion(piece_at(t), t, y); }
  MotionState motion(std::size_t piece, double t, const double* y) const;
  std::vector<double> state(double t, const MotionState& motion) const { return state(piece_at(t), t, motion); }
  std::vector<double> state(std::size_t piece, double t, const MotionState& motion) const;
  /// Appends a row, with the radial displacement and the force on the supports.
  void append(double t, const double* y, Trajectory& trajectory) const;

 private:
  struct State;
  explicit StudyEquations(std::shared_ptr<const State> state);
  std::shared_ptr<const State> state_;
};

}  // namespace equipoise
