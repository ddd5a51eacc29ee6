// The balanced state nearest to a state, where balanced states form a continuum; refined as its system needs.
#pragma once

#include <optional>
#include <variant>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

struct BalancedMember {
  Eigen::VectorXd state;
  std::variant<Equilibrium, PeriodicOrbit> refined;  ///< an orbit with a stroboscopic section
  double rate = -1.0;                                ///< of the slowest deviation across the continuum
  bool attracts = false;                             ///< in all directions across it
};

/// Empty if there is none. With a stroboscopic section also if none is within `reach` (in System::scale()) of exact
/// balance.
std::optional<BalancedMember> nearest_balanced(const model::System& system, const Eigen::VectorXd& state, double reach);

Motion describe(const model::System& system, const BalancedMember& member);

}  // namespace equipoise
