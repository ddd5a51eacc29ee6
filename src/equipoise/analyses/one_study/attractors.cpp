// A search for attractors: an ensemble whose catalogue is kept.
#include "equipoise/analyses/one_study/attractors.hpp"

#include <algorithm>
#include <cstdint>
#include <map>

#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/start_runs/checks.hpp"

namespace equipoise {

AttractorsResult attractors(const Study& asked, const AttractorsOptions& options) {
  check_offers(asked, model::ResultKind::attractors);
  Study study = with_medians(asked);
  study.sampling.starts = options.starts;
  AttractorsResult result;
  BasinOptions search = options;
  search.transients = options.transients.value_or(false);  // [limits] do not affect the motions
  if (options.progress)
    search.progress = [&](Progress p) {
      if (!p.preparing) p.what = "starts searched";
      p.balanced.reset();
      options.progress(p);
    };
  // An ensemble counts all starts whose rotor does not come up to speed as one outcome. Here they count by motion.
  std::map<int, std::uint64_t> stalled;
  search.outcome = [&](const Outcome& outcome) {
    if (outcome.kind == OutcomeKind::stalled) ++stalled[outcome.attractor];
    if (options.outcome) options.outcome(outcome);
  };
  Catalogue catalogue;
  result.basin = basin(study, search, &catalogue);
  result.attractors = catalogue.attractors();
  auto& shares = result.basin.attractors;
  for (const Attractor& a : result.attractors) {
    const auto same = [&](const OutcomeShare& s) { return s.id == a.id; };
    if (std::any_of(shares.begin(), shares.end(), same)) continue;
    shares.push_back({a.id, a.name, a.alias, wilson_share(stalled[a.id], result.basin.starts), name_of(a.motion.kind)});
  }
  return result;
}

}  // namespace equipoise
