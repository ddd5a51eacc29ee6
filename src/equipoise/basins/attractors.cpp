// The search for attractors is an ensemble whose catalogue is kept.
#include "equipoise/basins/attractors.hpp"

#include "equipoise/fates/start_runner.hpp"

namespace equipoise {

AttractorsResult attractors(const Study& study, const BasinOptions& options) {
  check_prescribed(study, "attractors");
  AttractorsResult result;
  result.basin = basin(study, options, &result.catalogue);
  return result;
}

}  // namespace equipoise
