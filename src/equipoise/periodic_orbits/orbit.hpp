// Equilibria and periodic orbits of smooth systems, refined to machine accuracy, with their linear stability: of flows,
// and of systems that are seen at strobes only (model::Section).
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/types/periodic_orbit.hpp"

namespace equipoise {

/// A state at which nothing moves in the rotating frame.
struct Equilibrium {
  Eigen::VectorXd state;         ///< as in model/system.hpp
  Eigen::VectorXcd eigenvalues;  ///< of the exact Jacobian, falling real part
  double residual = 0.0;         ///< largest |component of dz/dt|
};

/// Newton's method from `guess` with the exact Jacobian, where nothing depends on the rotor's angle. Empty if it does
/// not converge.
std::optional<Equilibrium> refine_equilibrium(const model::System& system, const Eigen::VectorXd& guess);

/// Multiple shooting by Newton's method on all nodes, and on the period where it is free, with exact derivatives
/// (variational equations from the model on dual numbers). `guess`: states at equally spaced times of one period,
/// angles unwrapped; the winding is taken from how far the last arc ends from the first node. Of a strobed system:
/// states at successive strobes, which also tell the period, and where the equations for the nodes are singular (a
/// continuum of balanced states) the least change is taken. Empty if it does not converge, or goes farther than `reach`
/// (in System::scale()) from the guess, or if the period is free and the motion found is an equilibrium. The period
/// returned is the smallest one. Empty, too, once `stop` is set.
std::optional<PeriodicOrbit> refine_orbit(const model::System& system, const std::vector<Eigen::VectorXd>& guess,
                                          double period, double reach = std::numeric_limits<double>::infinity(),
                                          const StopFlag* stop = nullptr);
/// The same with nodes `strobe` apart, whatever the section: for systems that are about to become strobed.
std::optional<PeriodicOrbit> refine_imposed_orbit(const model::System& system,
                                                  const std::vector<Eigen::VectorXd>& guess, double strobe,
                                                  double reach = std::numeric_limits<double>::infinity(),
                                                  const StopFlag* stop = nullptr);
/// The same from one state near the orbit and the time after which it returns.
std::optional<PeriodicOrbit> refine_orbit(const model::System& system, const Eigen::VectorXd& state, double period);
/// The orbit that a neighbouring system's goes over into, by a few steps of the same method: empty, too, if it has
/// another winding. Cheaper than refine_orbit() where there is none.
std::optional<PeriodicOrbit> continue_orbit(const model::System& system, const PeriodicOrbit& neighbour, double reach,
                                            const StopFlag* stop = nullptr);

/// An orbit of a flow where there may be none: single shooting first, undamped and true to about 1e-5 only. That is
/// good enough for stable orbits, and it gives up early where there is none (on a torus a second multiplier is near 1,
/// whatever the time, and steps do not shrink).
std::optional<PeriodicOrbit> find_orbit(const model::System& system, const Eigen::VectorXd& state, double period,
                                        double reach, const StopFlag* stop = nullptr);

/// `count` >= 1 states at equally spaced times of one period, from nodes[0] on, angles unwrapped. Empty if an
/// integration fails.
std::vector<Eigen::VectorXd> sample_orbit(const model::System& system, const PeriodicOrbit& orbit, int count);

/// Deviations near a periodic orbit in Floquet coordinates: w_k(t) . d, whose modulus changes as e^{rate_k t}.
struct FloquetFrame {
  std::vector<Eigen::VectorXd> states;  ///< as from sample_orbit
  /// One matrix a state; column k is the left Floquet vector w_k there (bilinear product, no conjugation). All but the
  /// shift in time; w_k . dz/dt = 0. Scaled so that the mean of |w_k|^2 over the orbit is 1; |w_k(t) . d| is periodic
  /// in t for fixed d.
  std::vector<Eigen::MatrixXcd> left;
  Eigen::VectorXd rates;  ///< log|multiplier_k| / period
};

/// Of an orbit whose period is free. Empty if the multipliers span too many powers of ten for double precision to
/// separate the vectors.
std::optional<FloquetFrame> floquet_frame(const model::System& system, const PeriodicOrbit& orbit, int count);

/// The largest `count` Lyapunov exponents along the trajectory from `state`, which should lie on the motion asked
/// about: mean growth of tangent vectors, reorthonormalised (Benettin and others, Meccanica 15 (1980) 9), over
/// `duration` after a further fifth of it for the vectors to align. Falling order. Accuracy about 1 / duration; at two
/// balls 1e4 units take a quarter of a second for four exponents, half for all. Of a strobed system the state is at a
/// strobe, and no exponent of 0 belongs to a shift in time. Empty if the integration fails, and once `stop` is set.
std::vector<double> lyapunov_exponents(const model::System& system, const Eigen::VectorXd& state, double duration,
                                       int count, const StopFlag* stop = nullptr);

}  // namespace equipoise
