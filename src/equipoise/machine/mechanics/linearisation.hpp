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

}  // namespace equipoise::model
