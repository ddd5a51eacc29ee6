// Vibration figures of starts that end in a motion, known beforehand from the motion itself.
#pragma once

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/types/transient_table.hpp"

namespace equipoise {

/// Exactly zero for a balanced state without gravity and with a centred race. A periodic motion is measured over its
/// period; a torus or chaos over 2000 time units, or as long as its statistics took. A start's own windows would show
/// too low peaks. Not for motions known by windows alone (MotionKind::measured).
MotionFigures motion_figures(const model::Parameters& p, const Motion& motion, const WatchedShaft& shaft = {});

/// What is known of the end of starts that come to `attractor`. Under gravity, balance is a single motion for one ball
/// or two alike balls (up to their exchange). Otherwise different balanced motions share the name, so figures are
/// measured, after five time constants of the motion at hand.
KnownEnd known_end(const model::Parameters& p, const Attractor& attractor, const WatchedShaft& shaft = {});

}  // namespace equipoise
