// What lanes ask of the trapping regions around motions and continua.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/trapping_regions/continuum_region.hpp"
#include "equipoise/trapping_regions/orbit_region.hpp"
#include "equipoise/trapping_regions/stalled_region.hpp"

namespace equipoise {

using OrbitRegions = std::vector<std::shared_ptr<const OrbitRegion>>;

/// Makes `rule` ask all of these, and the continuum if there is one, in place of what it asked before of the kind: at
/// every step where nothing depends on the rotor's angle, else, and of a continuum around a race off its centre, one
/// state at a time and with that angle, where half a window ends. SharedRegions of balanced states stay as they are.
void set_regions(ClassificationRule& rule, const model::System& system, const OrbitRegions& cycles,
                 const std::optional<ContinuumRegion>& continuum, const std::optional<StalledRegion>& stalled = {});

/// Dry friction holds all balls for good where they stick; which of `listed` that is, its catalogue says.
SharedRegions stuck_balls(const model::System& system, const Catalogue& listed);

}  // namespace equipoise
