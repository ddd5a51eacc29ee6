// Trapping regions around motions and continua, as lanes test them.
// This room: regions around all other attractors, validated by trajectories.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/trapping_regions/continuum_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/classification/trapping_regions/stalled_region.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

using OrbitRegions = std::vector<std::shared_ptr<const OrbitRegion>>;

/// Makes `rule` test all of these, and the continuum if there is one, in place of earlier ones. If nothing depends on
/// the rotor's angle, lanes test at every step. Otherwise, and for a continuum under an off-centre race, states are
/// tested one by one, with that angle, where half a window ends. Regions of balanced states stay as they are.
void set_regions(ClassificationRule& rule, const model::System& system, const OrbitRegions& cycles,
                 const std::optional<ContinuumRegion>& continuum, const std::optional<StalledRegion>& stalled = {});

/// Recognises balls that dry friction holds for good; the catalogue `listed` names their motion.
SharedRegions stuck_balls(const model::System& system, const Catalogue& listed);

}  // namespace equipoise
