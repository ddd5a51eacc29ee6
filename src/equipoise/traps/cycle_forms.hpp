// The quadratic forms of traps around periodic motions.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "equipoise/model/system.hpp"
#include "equipoise/motions/motion.hpp"
#include "equipoise/traps/cycle_trap.hpp"

namespace equipoise {

/// Share of the slowest rate that a form's decay is asked to reach: nearer to 1 it would be all slow directions.
inline constexpr double share_of_rate = 0.8;

/// P = sum_k Re(conj(w_k) w_k^T) of the left Floquet vectors at one state of an orbit (FloquetFrame::left).
Eigen::MatrixXd floquet_form(const Eigen::MatrixXcd& left);

/// The traps of a stable periodic motion, and where the rotor's angle matters of a balanced equilibrium, their levels
/// still 0: one trap for each motion that exchange of like balls makes of it, or, with the rotor's angle
/// as phase, one for all of them. Empty where none can be made: too long a period, no ball that turns steadily, too
/// many images, Floquet vectors that double precision cannot separate, a continuum, a failed integration.
std::vector<CycleTrap> cycle_traps(const model::System& system, const Motion& motion, int attractor);

}  // namespace equipoise
