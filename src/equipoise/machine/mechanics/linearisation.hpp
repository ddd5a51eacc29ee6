// The equations linearised about a steady state at constant speed.
// This room: what follows without integration: energy, linear theory, forced vibration, what an answer needs.
#pragma once

#include <Eigen/Core>

#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// d(dz/dt)/dz of the free-ball equations at state `z` and constant `speed`, with isotropic supports and no gravity.
/// The derivative is exact: the equations run on dual numbers. Variables as in parameters.hpp.
Eigen::MatrixXd jacobian(const Parameters& p, double speed, const double* z);

/// dz/dt of the same equations; `psi`: the rotor's angle, for anisotropic supports or gravity.
Eigen::VectorXd derivative(const Parameters& p, double speed, const double* z, double psi = 0.0);

/// dy/dt of a smooth system at state `y`, and its exact derivative with respect to y. `psi`: the rotor's angle on
/// a stroboscopic section, where the state does not hold it.
Eigen::VectorXd rate(const System& system, const Eigen::VectorXd& y, double psi = 0.0);
Eigen::MatrixXd jacobian(const System& system, const Eigen::VectorXd& y, double psi = 0.0);

/// The state with the rotor centred and the balls at rest at `phi`.
Eigen::VectorXd centred_state(const Parameters& p, const double* phi);

/// d2/da db of dy/dt at y + a u + b v, at a = b = 0, for an autonomous system, plain or at a prescribed speed with a
/// tilt. Exact: the equations run on dual numbers of dual numbers.
Eigen::VectorXd second_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& v);
/// d3/da db dc at y + a u + b v + c w.
Eigen::VectorXd third_derivative(const System& system, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
                                 const Eigen::VectorXd& v, const Eigen::VectorXd& w);

}  // namespace equipoise::model
