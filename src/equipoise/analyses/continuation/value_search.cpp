// A plain attractor search, without its shares.
#include "equipoise/analyses/continuation/value_search.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "equipoise/analyses/continuation/branch_follower.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"

namespace equipoise {

ValueSearch attractors_at(const Study& study, std::uint64_t starts,
                          const std::vector<std::vector<double>>& warm_start_states, const StopFlag* stop) {
  AttractorsOptions search;
  search.starts = starts;
  search.threads = 1;
  search.warm_start_states = warm_start_states;
  search.stop = stop;
  const AttractorsResult found = attractors(study, search);
  ValueSearch result;
  std::map<std::string, std::pair<std::uint64_t, const Motion*>> commonest;
  for (const Attractor& a : found.attractors) {
    if (!a.motion.stable && a.name != "balanced") continue;
    if (a.motion.kind == MotionKind::measured) continue;  // no state to continue from
    result.motions.push_back(a.motion);
    const auto share = std::find_if(found.basin.attractors.begin(), found.basin.attractors.end(),
                                    [&](const OutcomeShare& s) { return s.id == a.id; });
    auto& [most, motion] = commonest[family_of(study.parameters, a.motion)];
    if (!motion || share->share.count > most) std::tie(most, motion) = std::pair(share->share.count, &a.motion);
  }
  for (const auto& [name, most] : commonest) result.commonest.push_back(*most.second);
  return result;
}

}  // namespace equipoise
