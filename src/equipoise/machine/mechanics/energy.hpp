// Mechanical energy, the powers that change it, and the force on the supports.
// Units: energy M R^2 omega_c^2, power M R^2 omega_c^3, force M R omega_c^2. docs/explanation/equations.md, "Energy".
#pragma once

#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// dE/dt = drive - supports - balls.
struct Powers {
  double drive;     ///< torque tau needed for the prescribed motion, times psi'
  double supports;  ///< dissipated in the supports' dampers
  double balls;     ///< dissipated by ball drag
};

/// Energy of rotor and balls at time `t` of `segment` in state `z` (dimension(balls) numbers). `inertia`: iota = I_C/(M
/// R^2) about the centre of mass; for a prescribed motion it only adds iota psi'^2/2 here and the matching drive power.
double energy(const Parameters& p, double inertia, const Segment& segment, double t, const double* z);

/// Powers at the same instant, with the segment's clamp.
Powers powers(const Parameters& p, double inertia, const Segment& segment, double t, const double* z);

/// The same of a tilting rotor, in a state of machine_layout(p): `torque`, on the rotor; `held`: whether its balls
/// are.
Powers tilting_powers(const Parameters& p, double torque, bool held, const double* z);

/// Energy of a machine in state `z` (of machine_layout(p)), with its own inertia and race.
double full_energy(const Parameters& p, const double* z);

/// What the supports' dampers take from a tilting rotor in addition to damping[0] X'^2 + damping[1] Y'^2. `z`, `tilt`:
/// its state and the four variables of the tilt.
double power_taken_from_tilt(const Parameters& p, double psi, const double* z, const double* tilt);

/// Force of springs and dampers on the support in fixed axes, zeta X' + kappa X, as {X, Y}, at rotor angle `psi`.
/// `tilt`: the four variables of a tilting rotor, whose supports are taken together.
std::array<double, 2> bearing_force(const Parameters& p, double psi, const double* z, const double* tilt = nullptr);

}  // namespace equipoise::model
