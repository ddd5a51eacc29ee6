// What pictures of stability and of charts share.
#pragma once

#include <string>

#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/report/drawing/svg.hpp"

namespace equipoise {

/// The plane's axes, in the machine's units if it has them.
SvgAxes plane_axes(Svg& svg, const StabilityPlane& plane);

/// The drawing as a picture file below the title and the parameters that stay.
std::string plane_plot(const Svg& drawing, const StabilityPlane& plane, const std::string& title, bool complete,
                       const char* caption);

}  // namespace equipoise
