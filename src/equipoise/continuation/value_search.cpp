// A plain attractor search, without its shares.
#include "equipoise/continuation/value_search.hpp"

#include "equipoise/analyses/attractors.hpp"

namespace equipoise {

ValueSearch attractors_at(const Study& study, std::uint64_t starts,
                          const std::vector<std::vector<double>>& warm_start_states, const StopFlag* stop) {
  AttractorsOptions search;
  search.starts = starts;
  search.threads = 1;
  search.warm_start_states = warm_start_states;
  search.stop = stop;
  ValueSearch result;
  for (const Attractor& a : attractors(study, search).attractors) {
    if (a.motion.stable || a.name == "balanced") result.motions.push_back(a.motion);
    if (a.id < first_free_id) result.named.push_back(a.motion);
  }
  return result;
}

}  // namespace equipoise
