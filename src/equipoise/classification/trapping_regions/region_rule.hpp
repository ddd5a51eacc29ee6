// Trapping regions around motions and continua, as lanes test them.
// This room: regions around all other attractors, validated by trajectories.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/trapping_regions/continuum_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/machine/mechanics/gravity_well.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// All energy is lost, so the rotor comes to rest: in one place, or in one for each order of unlike touching balls.
struct StalledRegion {
  struct Rest {
    std::vector<int> order;  ///< kinds of balls side by side; empty: any order
    int attractor = 0;
  };

  model::GravityWell well;
  std::vector<Rest> rests{};

  /// The rest that `state` will come to; 0 if not known yet.
  int caught(const model::System& system, const double* state) const;
};

/// Kinds of the balls at `state` in order along the race, from one top to the other, each named by its first ball;
/// empty if order does not matter.
std::vector<int> order_of(const model::System& system, const double* state);

/// A state near rest for each order; only one if there are too many orders.
std::vector<Eigen::VectorXd> places_to_hang(const model::System& system, const model::GravityWell& well);

using OrbitRegions = std::vector<std::shared_ptr<const OrbitRegion>>;

/// Makes `rule` test all of these, and the continuum if there is one, in place of earlier ones. If nothing depends on
/// the rotor's angle, lanes test at every step. Otherwise, and for a continuum under an off-centre race, states are
/// tested one by one, with that angle, where half a window ends. Regions of balanced states stay as they are.
void set_regions(ClassificationRule& rule, const model::System& system, const OrbitRegions& cycles,
                 const std::optional<ContinuumRegion>& continuum, const std::optional<StalledRegion>& stalled = {});

/// Recognises balls that dry friction holds for good; the catalogue `listed` names their motion.
SharedRegions stuck_balls(const model::System& system, const Catalogue& listed);

}  // namespace equipoise
