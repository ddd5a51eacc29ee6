// Equilibria and periodic orbits of the constant-speed system, refined to machine accuracy, with their linear
// stability. Isotropic supports, no gravity: only then do the equations not depend on time.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// A state at which nothing moves in the rotating frame.
struct Equilibrium {
  Eigen::VectorXd state;         ///< as in model/parameters.hpp
  Eigen::VectorXcd eigenvalues;  ///< of the exact Jacobian, falling real part
  double residual = 0.0;         ///< largest |component of dz/dt|
};

/// Newton's method from `guess` with the exact Jacobian. Empty if it does not converge.
std::optional<Equilibrium> refine_equilibrium(const model::Parameters& p, double speed, const Eigen::VectorXd& guess);

/// A motion that repeats itself after `period`, ball angles taken modulo 2 pi.
struct PeriodicOrbit {
  double period = 0.0;
  std::array<int, model::max_balls> winding{};  ///< whole turns of each ball in one period, with sign
  /// States at the times k period / nodes.size(), k = 0, 1, ...; angles unwrapped along the orbit.
  std::vector<Eigen::VectorXd> nodes;
  /// Floquet multipliers: eigenvalues of the monodromy matrix. The first is the one that belongs to a shift in time
  /// (1 but for errors); the others follow with falling modulus. Errors are about 1e-12 of the largest.
  Eigen::VectorXcd multipliers;
  double residual = 0.0;  ///< largest mismatch of any component where one node's arc meets the next node

  /// Every multiplier but the first lies inside the unit circle.
  bool stable() const;
};

/// Multiple shooting by Newton's method on all nodes and the period, with exact derivatives (variational equations from
/// the model on dual numbers). `guess`: states at equally spaced times of one period, angles unwrapped; the winding is
/// taken from how far the last arc ends from the first node. Empty if it does not converge, or if the motion found is
/// an equilibrium. The period returned is the smallest one.
std::optional<PeriodicOrbit> refine_orbit(const model::Parameters& p, double speed,
                                          const std::vector<Eigen::VectorXd>& guess, double period);
/// The same from one state near the orbit and the time after which it returns.
std::optional<PeriodicOrbit> refine_orbit(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                          double period);

/// `count` >= 1 states at equally spaced times of one period, from nodes[0] on, angles unwrapped. Empty if an
/// integration fails.
std::vector<Eigen::VectorXd> sample_orbit(const model::Parameters& p, double speed, const PeriodicOrbit& orbit,
                                          int count);

/// Deviations near a periodic orbit in Floquet coordinates: w_k(t) . d, whose modulus changes as e^{rate_k t}.
struct FloquetFrame {
  std::vector<Eigen::VectorXd> states;  ///< as from sample_orbit
  /// One matrix a state; column k is the left Floquet vector w_k there (bilinear product, no conjugation). All but the
  /// shift in time; w_k . dz/dt = 0. Scaled so that the mean of |w_k|^2 over the orbit is 1; |w_k(t) . d| is periodic
  /// in t for fixed d.
  std::vector<Eigen::MatrixXcd> left;
  Eigen::VectorXd rates;  ///< log|multiplier_k| / period
};

/// Empty if the multipliers span too many powers of ten for double precision to separate the vectors.
std::optional<FloquetFrame> floquet_frame(const model::Parameters& p, double speed, const PeriodicOrbit& orbit,
                                          int count);

/// The largest `count` Lyapunov exponents along the trajectory from `state`, which should lie on the motion asked
/// about: mean growth of tangent vectors, reorthonormalised (Benettin and others, Meccanica 15 (1980) 9), over
/// `duration` after a further fifth of it for the vectors to align. Falling order. Accuracy about 1 / duration; at two
/// balls 1e4 units take a quarter of a second for four exponents, half for all. Empty if the integration fails, and
/// once `stop` is set.
std::vector<double> lyapunov_exponents(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                       double duration, int count, const StopFlag* stop = nullptr);

/// The state a time `duration` >= 0 later (adaptive DOP853, tolerance 1e-12), or empty if the integration fails.
std::optional<Eigen::VectorXd> advance_state(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                             double duration, double psi = 0.0);

}  // namespace equipoise
