// A steady motion: what kind it is, what the balls do on it, how much it vibrates, and what it is called.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "equipoise/machine/model/ball_mode.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/ball_events.hpp"
#include "equipoise/results/types/periodic_orbit.hpp"

namespace equipoise {

/// `measured`: known from windows of time, or from energy, alone.
enum class MotionKind { equilibrium, periodic, quasi_periodic, chaotic, measured };
constexpr const char* name_of(MotionKind kind) {
  constexpr std::array<const char*, 5> names{"equilibrium", "periodic", "quasi-periodic", "chaotic", "measured"};
  return names[static_cast<std::size_t>(kind)];
}
/// Tori and chaos: no two stretches of them are quite the same.
constexpr bool never_repeats(MotionKind kind) {
  return kind == MotionKind::quasi_periodic || kind == MotionKind::chaotic;
}

/// What turns the rotor along a motion under a motor, and what that takes. Units as in docs/explanation/equations.md.
struct MotorLoad {
  model::DrivePiece drive;                  ///< the motor
  double speed_min = 0.0, speed_max = 0.0;  ///< extremes of psi'
  double torque = 0.0, power = 0.0;         ///< means of what the motor gives
  double support_power = 0.0;  ///< the part of it that the supports' dampers take; the balls' drag has the rest
};

/// Zero eigenvalues of a continuum of balanced states are zero to rounding; the slowest others seen are 1e-4.
inline constexpr double zero_eigenvalue = 1e-8;

/// Everything known of one motion of a system in the last piece of its drive, refined as far as its kind allows.
struct Motion {
  MotionKind kind = MotionKind::equilibrium;
  double speed = 0.0;                            ///< Omega; under a motor the mean of psi'
  std::optional<MotorLoad> motor;                ///< empty where the speed is prescribed
  Eigen::VectorXd state;                         ///< a state on it, angles in [0, turn)
  double period = 0.0;                           ///< periodic only
  Winding winding{};                             ///< periodic only: whole turns of each angle in one period, with sign
  std::array<double, model::max_balls> drift{};  ///< mean phi'
  std::array<double, model::max_balls> rate_min{}, rate_max{};  ///< extremes of phi'
  double r_min = 0.0, r_mean = 0.0, r_max = 0.0;                ///< distance of the rotor's centre from the axis
  Eigen::VectorXcd spectrum;      ///< eigenvalues (equilibrium) or Floquet multipliers (periodic, shift in time first)
  std::vector<double> exponents;  ///< Lyapunov exponents, falling: Re eigenvalue, log|multiplier|/period, or measured
  bool stable = false;            ///< attracts its neighbourhood (linear stability; measured for the other two kinds)
  double residual = 0.0;          ///< of the refinement; 0 for motions that cannot be refined
  PeriodicOrbit orbit;            ///< periodic only
  /// Of a rotor with anisotropic supports or gravity, whose equations depend on its angle, while it turns. r is
  /// measured from where the rotor rests under gravity; `spectrum` of an equilibrium too are multipliers, over one
  /// section period. At a prescribed speed `state` holds where psi = 0, and every multiplier counts.
  bool depends_on_angle = false;
  int sections =
      0;  ///< periodic and with a stroboscopic section only: turns of the rotor, by section_angle(), in `period`
  /// With a stroboscopic section: gravity and anisotropy taken away gradually lead to a balanced state. Stuck or with
  /// events: it vibrates less than half as much as the rotor would without balls (halves_the_shaking()).
  bool balanced = false;
  double duration = 0.0;  ///< time over which the statistics were taken; 0 for an equilibrium

  // Of systems with events.
  model::BallMode mode;           ///< which balls touch and which stick, at `state`
  std::vector<BallEvent> events;  ///< in one period; of motions that do not come back, the last hundred
  bool eventful = false;          ///< balls touch or stick somewhere on it; else it is one of the system without events
  bool stuck = false;             ///< stiction holds all balls for good, with what unbalance is left (stuck.hpp)
  /// It belongs to a continuum that dry friction makes: sticking balls may do so a little further on.
  bool set_valued = false;

  // What the balls do, by topology.
  /// Balls that move as one (angles equal modulo 2 pi all along) share a number; numbers count from 0.
  std::array<int, model::max_balls> cluster{};
  /// All relative angles phi_i - phi_j stay between -pi and pi: the balls travel together without being coincident.
  bool together = false;
  /// Two balls that drift at the same mean rate: how often they pass through opposite places, per turn of the pair.
  double oppositions_per_turn = 0.0;
  /// Balls with the same mean phi' share a number; 0 belongs to balls without one (captured), the others count from 1
  /// in the order of the balls. Exact for periodic motions; for measured ones up to what chance allows.
  std::array<int, model::max_balls> drift_group{};
  /// For two equal balls: the motion is its own exchange image half a period later.
  bool half_period_exchange = false;
  /// Different motions made from this one by exchanging equal balls; 1 if exchange maps it onto itself.
  std::int64_t copies = 1;
};

/// What a motion is called. Names follow from topology alone (see docs/explanation/motions.md); `id` is fixed for the
/// motions of two balls that have names of their own (balanced 1, co-drifting 2, drifting apart 3, one captured 4, one
/// captured with period 4 5, pair drift 6, locked 7) and 0 for all others. Under a motor the same names, and what
/// becomes of the rotor behind them: "captured at resonance", "backwards"; a rotor that does not turn is "stalled",
/// whatever the balls do (docs/explanation/motions.md).
struct MotionName {
  std::string name, alias;  ///< alias: V1 to V4 of Wright and Peng (2019), two balls only, else empty
  int id = 0;
};

}  // namespace equipoise
