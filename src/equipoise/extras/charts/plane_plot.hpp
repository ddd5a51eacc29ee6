// What pictures of stability and of charts share.
#pragma once

#include <string>

#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/report/drawing/svg.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// The plane's axes, in the machine's units if it has them.
SvgAxes plane_axes(Svg& svg, const StabilityPlane& plane);

/// The drawing as a picture file below the title and the parameters that stay.
std::string plane_plot(const Svg& drawing, const StabilityPlane& plane, const std::string& title, bool complete,
                       const char* caption);

/// Its label, what a dimensionless value is multiplied by, and the unit that it then has, if any.
struct ShownAxis {
  std::string label;
  double factor = 1.0;
  std::string unit = {};
};
/// In the machine's units if it has them.
ShownAxis shown_axis(const Study& study, const SliceAxis& axis);

}  // namespace equipoise
