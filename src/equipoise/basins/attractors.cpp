// The search for attractors is an ensemble whose catalogue is kept.
#include "equipoise/basins/attractors.hpp"

#include "equipoise/fates/start_runner.hpp"

namespace equipoise {

AttractorsResult attractors(const Study& asked, const AttractorsOptions& options) {
  check_offers(asked, model::Answer::attractors);
  Study study = asked;
  study.sampling.starts = options.starts;
  AttractorsResult result;
  BasinOptions search = options;
  search.transients = options.transients.value_or(false);  // [limits] play no part in which motions there are
  if (options.progress)
    search.progress = [&](Progress p) {
      if (!p.preparing) p.what = "starts searched";
      p.balanced.reset();
      options.progress(p);
    };
  result.basin = basin(study, search, &result.catalogue);
  return result;
}

}  // namespace equipoise
