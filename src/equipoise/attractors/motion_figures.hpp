// The figures of vibration that every start ends with which comes to a motion: known beforehand, from the motion
// itself.
#pragma once

#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/attractors/motion.hpp"
#include "equipoise/model/parameters.hpp"
#include "equipoise/types/transient_table.hpp"

namespace equipoise {

/// Exactly zero for a balanced state without gravity and with the race centred. Of a periodic motion over its period,
/// of a torus or of chaos over 2000 units of time or as long as its statistics took: a start's own windows would show
/// its peaks too low. Not of motions that are known by their windows alone (MotionKind::measured).
MotionFigures motion_figures(const model::Parameters& p, const Motion& motion);

/// What is known of the end of starts that come to `attractor`. Under gravity balance is one motion for two equal balls
/// (up to their exchange) or a single ball. Several that differ share the name otherwise: figures are then measured,
/// after five time constants of the one at hand.
KnownEnd known_end(const model::Parameters& p, const Attractor& attractor);

}  // namespace equipoise
