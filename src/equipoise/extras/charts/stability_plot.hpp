// A picture of where balance is stable.
#pragma once

#include <string>

#include "equipoise/extras/planes/stability_plane.hpp"

namespace equipoise {

/// A picture file (SVG). Where balance is stable or unstable the plane is the darker, the faster deviations die out or
/// grow. Lines show where a pair of eigenvalues crosses (solid), where a real one does (dotted) and where the balanced
/// state ends (dashed); a ring the study's own point. Axes are in the machine's units if it has them. `title` goes
/// before the parameters.
std::string stability_plot(const StabilityPlane& plane, const std::string& title);

}  // namespace equipoise
