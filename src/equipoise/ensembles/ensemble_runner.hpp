// Whoever decides the starts of a basin(): itself, or another process on its behalf.
#pragma once

#include <memory>

#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/ensembles/chunks.hpp"
#include "equipoise/start_runs/start_runner.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Everything that basin() settles before it makes its runner.
Study as_sampled(Study study, SamplingMethod method);

/// What the options of a basin() ask of the search for attractors. `discoveries`: or null.
AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* discoveries);

/// The study has its horizon and its method of sampling. Of the options those of the search and of transients count.
std::unique_ptr<StartRunner> ensemble_runner(const Study& study, const BasinOptions& options,
                                             AttractorSearchCache& discoveries);

/// One that goes on deciding when whoever might have stopped its search is gone: what is found here it finds again, in
/// `found`. The study as above. Throws RunError if stopped.
std::unique_ptr<StartRunner> lasting_runner(const Study& study, const RunOptions& options, bool transients,
                                            AttractorSearchCache& found);

/// Fills a chunk in, or completes one from elsewhere. Thread-safe; false if stopped early.
bool classify_chunk(const StartRunner& runner, Chunk& chunk);

/// Decides chunks of basin(study, options) with the very bits that it would give them.
class EnsembleHelper {
 public:
  /// `method`: as it samples. Ask stopped() afterwards.
  EnsembleHelper(Study study, const BasinOptions& options, SamplingMethod method);
  bool stopped() const { return runner_->stopped(); }
  /// Thread-safe; false if stopped early.
  bool decide(Chunk& chunk) const { return classify_chunk(*runner_, chunk); }

 private:
  std::unique_ptr<StartRunner> runner_;
};

}  // namespace equipoise
