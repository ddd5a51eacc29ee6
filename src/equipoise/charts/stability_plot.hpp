// A picture of where balance is stable, as a gnuplot script that contains the data.
#pragma once

#include <string>

#include "equipoise/planes/stability_plane.hpp"

namespace equipoise {

/// Draws into `path` (.png or .svg). Where balance is stable or unstable the plane is the darker, the faster deviations
/// die out or grow. Lines show where a pair of eigenvalues crosses (solid), where a real one does (dotted) and where
/// the balanced state ends (dashed); a ring the study's own point. Axes are in the machine's units if it has them.
std::string stability_plot_script(const StabilityPlane& plane, const std::string& title, const std::string& path);

}  // namespace equipoise
