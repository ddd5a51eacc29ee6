// All equilibria of a rotor that Newton's method finds from many arrangements of its balls, stable or not.
#pragma once

#include <vector>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/periodic_orbits/orbit.hpp"

namespace equipoise {

/// refine_equilibrium() from `starts` random arrangements of the balls, the rotor where it rests while they are held
/// there. Each equilibrium once, whatever balls that are alike exchange; without the balanced ones. The speed is
/// prescribed, and nothing depends on the rotor's angle.
std::vector<Equilibrium> unbalanced_equilibria(const model::System& system, int starts, const StopFlag* stop = nullptr);

}  // namespace equipoise
