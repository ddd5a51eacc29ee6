// The attractors of a study, with the shares of the starts that were searched.
#pragma once

#include <vector>

#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/types/attractor.hpp"

namespace equipoise {

struct AttractorsResult {
  std::vector<Attractor> attractors;  ///< by identifier
  BasinResult basin;                  ///< shares of the starts that were searched
};

}  // namespace equipoise
