// Equilibria and periodic orbits of smooth systems, refined to machine accuracy, with their linear stability; for
// flows, and on a stroboscopic section (model::Section).
// This room: periodic orbits found and refined, with multipliers and exponents.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/periodic_orbit.hpp"

namespace equipoise {

/// A state at rest in the rotating frame.
struct Equilibrium {
  Eigen::VectorXd state;         ///< as in machine/model/system.hpp
  Eigen::VectorXcd eigenvalues;  ///< of the exact Jacobian, by falling real part
  double residual = 0.0;         ///< largest |component of dz/dt|
};

/// Newton's method from `guess` with the exact Jacobian. Nothing may depend on the rotor's angle. Empty if it does not
/// converge.
std::optional<Equilibrium> refine_equilibrium(const model::System& system, const Eigen::VectorXd& guess);

/// Multiple shooting by Newton's method on all nodes, and on the period if it is free, with exact derivatives
/// (variational equations: the model on dual numbers). `guess`: states at equally spaced times of one period, angles
/// unwrapped. The winding follows from the gap between the last arc's end and the first node. With a stroboscopic
/// section the guess is states on successive sections, which fix the period. If the equations for the nodes are then
/// singular (a continuum of balanced states), the least change is taken. Empty if it does not converge, goes further
/// than `reach` (in System::scale()) from the guess, finds an equilibrium (with a free period), or if `stop` is set.
/// The returned period is the smallest one.
std::optional<PeriodicOrbit> refine_orbit(const model::System& system, const std::vector<Eigen::VectorXd>& guess,
                                          double period, double reach = std::numeric_limits<double>::infinity(),
                                          const StopFlag* stop = nullptr);
/// The same with nodes `section_period` apart, whatever the section: for systems about to get a stroboscopic section.
std::optional<PeriodicOrbit> refine_imposed_orbit(const model::System& system,
                                                  const std::vector<Eigen::VectorXd>& guess, double section_period,
                                                  double reach = std::numeric_limits<double>::infinity(),
                                                  const StopFlag* stop = nullptr);
/// The orbit that a neighbouring system's becomes, by a few steps of the same method. Also empty if its winding
/// differs. If there is no orbit, cheaper than refine_orbit().
std::optional<PeriodicOrbit> continue_orbit(const model::System& system, const PeriodicOrbit& neighbour, double reach,
                                            const StopFlag* stop = nullptr);

/// Looks for an orbit of a flow that may not exist. Single shooting comes first, undamped and accurate to about 1e-5
/// only. That suffices for stable orbits, and gives up early if there is none: on a torus a second multiplier is near
/// 1, whatever the time, and steps do not shrink.
std::optional<PeriodicOrbit> find_orbit(const model::System& system, const Eigen::VectorXd& state, double period,
                                        double reach, const StopFlag* stop = nullptr);

/// `count` >= 1 states at equally spaced times of one period, from nodes[0] on, angles unwrapped. Empty if an
/// integration fails.
std::vector<Eigen::VectorXd> sample_orbit(const model::System& system, const PeriodicOrbit& orbit, int count);

/// Floquet multipliers of a periodic orbit from its arcs (follow_arcs()). First comes the multiplier of the shift in
/// time, 1 up to errors, then the others with falling modulus. Absolute accuracy is about 1e-12 times the norm of the
/// product of all arcs, by integration errors; a smaller multiplier is noise.
Eigen::VectorXcd floquet_multipliers(const model::System& system, const std::vector<Eigen::VectorXd>& nodes,
                                     const std::vector<TangentFlight>& arcs);
/// The same for an imposed period: all with falling modulus, as none belongs to a shift in time.
Eigen::VectorXcd floquet_multipliers(const std::vector<TangentFlight>& arcs);

/// Deviations near a periodic orbit in Floquet coordinates w_k(t) . d, whose modulus changes as e^{rate_k t}.
struct FloquetFrame {
  std::vector<Eigen::VectorXd> states;  ///< as from sample_orbit()
  /// A matrix for each state; column k is the left Floquet vector w_k there (bilinear product, no conjugation). The
  /// shift in time is left out: w_k . dz/dt = 0. The mean of |w_k|^2 over the orbit is 1; |w_k(t) . d| is periodic in t
  /// for fixed d.
  std::vector<Eigen::MatrixXcd> left;
  Eigen::VectorXd rates;  ///< log|multiplier_k| / period
};

/// For an orbit with a free period. Empty if the multipliers span too many powers of ten for double precision to
/// separate the vectors.
std::optional<FloquetFrame> floquet_frame(const model::System& system, const PeriodicOrbit& orbit, int count);

/// The largest `count` Lyapunov exponents along the trajectory from `state`, which should lie on the motion in
/// question: mean growth of tangent vectors, reorthonormalised (Benettin and others, Meccanica 15 (1980) 9), over
/// `duration` after a further fifth of it in which the vectors align. Falling, accurate to about 1 / duration. With two
/// balls 1e4 time units take a quarter of a second for four exponents, half a second for all. With a stroboscopic
/// section `state` must lie on it, and no exponent of 0 belongs to a shift in time. Empty if the integration fails or
/// `stop` is set.
std::vector<double> lyapunov_exponents(const model::System& system, const Eigen::VectorXd& state, double duration,
                                       int count, const StopFlag* stop = nullptr);

}  // namespace equipoise
