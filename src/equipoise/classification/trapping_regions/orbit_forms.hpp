// Quadratic forms of trapping regions around periodic motions.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// Fraction of the slowest rate that a form's decay must reach: closer to 1 it would be all slow directions.
inline constexpr double share_of_rate = 0.8;

/// P = sum_k Re(conj(w_k) w_k^T) of the left Floquet vectors at one state of an orbit (FloquetFrame::left).
Eigen::MatrixXd floquet_form(const Eigen::MatrixXcd& left);

/// The trapping regions, with levels still 0, of a stable periodic motion or, if the rotor's angle matters, of a
/// balanced equilibrium. One region for each motion that exchange of alike balls makes of it or, with the rotor's angle
/// as phase, one for all of them. Empty if none can be made: too long a period, no ball that turns steadily, too many
/// images, Floquet vectors that double precision cannot separate, a continuum, a failed integration.
std::vector<OrbitRegion> orbit_regions(const model::System& system, const Motion& motion, int attractor);

}  // namespace equipoise
