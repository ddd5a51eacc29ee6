// The trapping region around a continuum of balanced states; trials set its level.
#pragma once

#include <memory>
#include <optional>

#include <Eigen/Core>

#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/classification/trapping_regions/continuum_estimate.hpp"
#include "equipoise/classification/trapping_regions/trials.hpp"

namespace equipoise {

/// Level sets around all attracting members, at a level found by trials of those that attract fast enough
/// (classification/trapping_regions/validated_level.hpp).
struct ContinuumRegion {
  std::shared_ptr<const ContinuumOfEquilibria> continuum;
  double factor = 0.0;                              ///< times every member's unit of V
  double slowest_rate = 0.0;                        ///< of the members tried (negative)
  Eigen::Vector4d place = Eigen::Vector4d::Zero();  ///< centre of members' x, y, u, v (on a section)
  double reach = 0.0;  ///< bound inside on x, y, u, v from `place`, and on velocities and unbalance from balance
  /// Estimates V from members tried beforehand, for V itself takes an analysis of the state's member. Null if it cannot
  /// tell inside from outside.
  std::shared_ptr<const ContinuumEstimate> estimate;
  double deep = 0.0;  ///< below this share of its level by the estimate, a state is inside
  double far = 0.0;   ///< above it, a state counts as outside; between them V is computed

  /// In place of `factor` for attracting members slower than those tried, if they rest; 0: they catch nothing.
  double slow_factor = 0.0;

  /// Refuses most states that are outside: those farther off than V allows. Null: none is refused.
  std::shared_ptr<const OffContinuum> off = nullptr;

  /// Whether a state (on a section if there is one) is inside. For a trajectory with a rotor of its own, around the
  /// members of that rotor's continuum.
  bool holds(const Eigen::VectorXd& state, const OwnRotor* own = nullptr) const;
};

/// Level sets around the attracting members of a continuum. All of 1024 trial states on twice their levels, spread over
/// the members, came near the continuum and were about to come to an attracting member; balls in contact may have
/// touched on the way. 256 trials if the rotor's angle matters. Slower members that rest have a hundredth of that
/// level. Empty if no level passes.
std::optional<ContinuumRegion> continuum_region(const std::shared_ptr<const ContinuumOfEquilibria>& continuum,
                                                const ContinuumSample& sample, const TrialSettings& settings);

}  // namespace equipoise
