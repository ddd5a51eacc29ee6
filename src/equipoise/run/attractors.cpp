// The search for attractors is an ensemble whose catalogue is kept.
#include "equipoise/run/attractors.hpp"

namespace equipoise {

AttractorsResult attractors(const Study& study, const BasinOptions& options) {
  AttractorsResult result;
  result.basin = basin(study, options, &result.catalogue);
  return result;
}

}  // namespace equipoise
