// All equilibria of a rotor, stable or not, that Newton's method finds from many arrangements of its balls. For rotors
// tilting about the centre of one race, also continua: three or more balls in that race balance its share at any of
// many angles, while the others do not balance theirs.
// This room: equilibria and continua of them, and what balls held by friction leave.
#pragma once

#include <vector>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/attractor.hpp"

namespace equipoise {

/// refine_equilibrium() from `starts` random arrangements of the balls, the rotor where it rests while they are held
/// there. Each equilibrium once, whatever balls that are alike exchange; without the balanced ones, and one of each
/// continuum. The speed is prescribed, and nothing depends on the rotor's angle.
std::vector<Equilibrium> unbalanced_equilibria(const model::System& system, int starts, const StopFlag* stop = nullptr);

/// Whether ball `i` is one of three or more in a race whose centre rests on the axis while the rotor vibrates.
bool has_free_angle(const model::System& system, const Eigen::VectorXd& equilibrium, int i);
/// How many angles such balls leave free: as many eigenvalues are zero. 0 of all other equilibria.
int free_angles(const model::System& system, const Eigen::VectorXd& equilibrium);
/// Which part of that continuum attracts.
ContinuumPart partly_balanced_part(const model::System& system, const Eigen::VectorXd& equilibrium);
/// Whether two equilibria with free angles are of one continuum: rotors rest alike.
bool same_continuum(const model::System& system, const Eigen::VectorXd& a, const Eigen::VectorXd& b);

}  // namespace equipoise
