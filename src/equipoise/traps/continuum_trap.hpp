// The trap around a continuum of balanced states: its level, found by tries.
#pragma once

#include <memory>
#include <optional>

#include "equipoise/orbits/balanced_continuum.hpp"
#include "equipoise/traps/trials.hpp"

namespace equipoise {

/// Level sets around the attracting members of a continuum: all of 1024 states on twice their levels, spread over the
/// members, came near to the continuum and were about to come to a member that attracts; balls in contact may have
/// touched on the way. Of 256 where the rotor's angle matters. Empty if there are none.
std::optional<ContinuumTrap> continuum_trap(const std::shared_ptr<const BalancedContinuum>& continuum,
                                            const ContinuumSurvey& survey, const TrialSettings& settings);

}  // namespace equipoise
