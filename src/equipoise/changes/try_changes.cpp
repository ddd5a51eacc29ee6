// Ensembles of studies with one thing changed.
#include "equipoise/changes/try_changes.hpp"

#include <utility>

#include "equipoise/ensembles/basin.hpp"
#include "equipoise/running/cpu_time.hpp"
#include "equipoise/running/reporting.hpp"

namespace equipoise {

namespace {

std::vector<TriedChange> tried(const Study& study, const RunOptions& options) {
  const std::vector<Change> changes = usual_changes(study);
  std::vector<TriedChange> done;
  const double begin = cpu_seconds();
  const auto spent = [begin] { return cpu_seconds() - begin; };
  for (std::size_t k = 0; k < changes.size() && !is_set(options.stop); ++k) {
    if (spent() > seconds_for_changes) break;
    if (options.progress) options.progress({k, changes.size(), "changes", {}, false});
    BasinOptions one;
    one.threads = options.threads;
    one.stop = options.stop;
    one.stop_asked = [spent] { return spent() > longest_for_changes; };
    one.cpu_target = options.cpu_target;
    one.transients = true;
    one.few_starts = true;
    const BasinResult result = basin(changes[k].study, one);
    if (result.partial) break;
    if (auto judged = tried_change(changes[k].words, result)) done.push_back(*std::move(judged));
    if (!done.empty() && done.back().decision == Decision::fit) break;
  }
  return done;
}

}  // namespace

std::vector<TriedChange> try_changes(const Study& study, const RunOptions& options) {
  return reported(options, [&](const RunOptions& inner) { return tried(study, inner); });
}

std::vector<TriedChange> changes_asked_for(const BasinResult& result, const RunOptions& options) {
  if (result.partial) return {};
  const auto verdict = verdict_of(result);
  return verdict && asks_for_changes(verdict->decision) ? try_changes(result.study, options)
                                                        : std::vector<TriedChange>{};
}

}  // namespace equipoise
