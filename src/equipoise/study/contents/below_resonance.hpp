// Studies whose rotor runs below its critical speed, where no balancer can help.
#pragma once

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Whether a rotor that does not tilt ends at a prescribed speed below its lowest critical speed with the balls, with
/// every value that its uncertain numbers may take. Vibration is in phase with unbalance there: balls move to where
/// the race is furthest out, the heavy side, and every balanced state is unstable. False if dry friction may hold balls
/// anywhere, or if an off-centre race decides where it is furthest out.
bool runs_below_resonance(const Study& study);

}  // namespace equipoise
