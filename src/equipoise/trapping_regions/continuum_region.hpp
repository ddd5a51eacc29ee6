// The trapping region around a continuum of balanced states: its level, found by tries.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "equipoise/periodic_orbits/continuum_of_equilibria.hpp"
#include "equipoise/trapping_regions/continuum_estimate.hpp"
#include "equipoise/trapping_regions/trials.hpp"

namespace equipoise {

/// Level sets around all members that approach fast enough, with a level that was tried
/// (trapping_regions/validated_level.hpp).
struct ContinuumRegion {
  std::shared_ptr<const ContinuumOfEquilibria> continuum;
  double factor = 0.0;        ///< of every member's unit of V
  double slowest_rate = 0.0;  ///< of the members that were tried (negative): slower ones catch nothing
  Eigen::Vector4d place = Eigen::Vector4d::Zero();  ///< about which x, y, u, v of members are (at a strobe)
  double reach = 0.0;  ///< x, y, u, v of every state inside are as near to it, velocities and imbalance to balance
  /// Of V, from members tried beforehand: to compute V of a state takes an analysis of the member it comes to. Null if
  /// it cannot tell inside from outside.
  std::shared_ptr<const ContinuumEstimate> estimate;
  double deep = 0.0;  ///< estimated below this share of its level, a state is inside
  double far = 0.0;   ///< estimated above it, a state counts as outside; between them V is computed

  /// Whether a state (where the rotor's angle matters one at a strobe) is inside.
  /// Of a trajectory with a rotor of its own: around the members of that rotor's continuum.
  bool holds(const Eigen::VectorXd& state, const OwnRotor* own = nullptr) const;
};

/// Whether all members drawn attract, the slowest at a tenth of the fastest's rate or more: none is left out then.
bool catches_all(const ContinuumPart& part);

/// Level sets around the attracting members of a continuum: all of 1024 states on twice their levels, spread over the
/// members, came near to the continuum and were about to come to a member that attracts; balls in contact may have
/// touched on the way. Of 256 where the rotor's angle matters. Empty if there are none.
std::optional<ContinuumRegion> continuum_region(const std::shared_ptr<const ContinuumOfEquilibria>& continuum,
                                                const ContinuumSurvey& survey, const TrialSettings& settings);

}  // namespace equipoise
