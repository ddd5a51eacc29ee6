// How an axis of a plane is drawn.
#pragma once

#include <string>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Its label, what a dimensionless value is multiplied by, and the unit that it then has, if any.
struct ShownAxis {
  std::string label;
  double factor = 1.0;
  std::string unit = {};
};
/// In the machine's units if it has them.
ShownAxis shown_axis(const Study& study, const SliceAxis& axis);

}  // namespace equipoise
