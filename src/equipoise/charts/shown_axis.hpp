// How an axis of a plane is drawn.
#pragma once

#include <string>

#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Its label, and what a dimensionless value is multiplied by.
struct ShownAxis {
  std::string label;
  double factor = 1.0;
};
/// In the machine's units if it has them.
ShownAxis shown_axis(const Study& study, const SliceAxis& axis);

}  // namespace equipoise
