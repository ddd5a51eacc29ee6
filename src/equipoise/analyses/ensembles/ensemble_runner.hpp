// What decides the starts of basin(): its own process, or another that helps it.
#pragma once

#include <memory>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/start_runner.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The study as basin() completes it before it makes its runner.
Study as_sampled(Study study, SamplingMethod method);

/// Checks options.initial, and makes the study's starts those. Throws InputError.
void take_own_starts(const BasinOptions& options, Study& study);

/// What the options of basin() ask of the attractor search. `searches` may be null.
AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* searches);

/// The study must have its horizon and method. Of `options` those of the search and of transients count.
std::unique_ptr<StartRunner> ensemble_runner(const Study& study, const BasinOptions& options,
                                             AttractorSearchCache& searches);

/// A runner that keeps deciding after the stop flag and callbacks of its search are gone. It searches with `options`
/// first and finds the result again in `found`. Study as above; `few_starts`: AttractorSearchSettings. Throws RunError if
/// stopped.
std::unique_ptr<StartRunner> lasting_runner(const Study& study, const RunOptions& options, bool transients,
                                            AttractorSearchCache& found, bool few_starts = false);

/// Decides a chunk, or completes one from another process. Thread-safe; false if stopped early.
bool classify_chunk(const StartRunner& runner, Chunk& chunk);

/// Decides chunks of basin(study, options) bit for bit as basin() does.
class EnsembleHelper {
 public:
  /// `method`: the one that basin() chose. Check stopped() afterwards.
  EnsembleHelper(Study study, const BasinOptions& options, SamplingMethod method);
  bool stopped() const { return runner_->stopped(); }
  /// Thread-safe; false if stopped early.
  bool decide(Chunk& chunk) const { return classify_chunk(*runner_, chunk); }

 private:
  std::unique_ptr<StartRunner> runner_;
};

}  // namespace equipoise
