// The starts of a study, any of them at any time: one search, then as many as one likes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/results/transient_figures.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/start_runs/start_runner.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/types/fate.hpp"

namespace equipoise {

struct EnsembleOptions : RunOptions {
  bool transients = false;                      ///< gather the figures of every start's transient
  AttractorSearchCache* discoveries = nullptr;  ///< shared by ensembles one after the other that end at the same speed
};

/// Decides starts by their numbers, and states of the caller's own, with the very bits that basin() gives them. For
/// those who show results as they come; basin() counts, keeps and resumes. One thread uses one of these.
///
/// A motion that the search had missed is listed once a start comes to it: where it has no identifier of its own
/// (first_free_id) it gets the next free one, in the order in which starts are asked for.
class Ensemble {
 public:
  /// Searches for attractors: progress is that of basin(). Throws InputError for studies that basin() would not decide;
  /// RunError if stopped.
  explicit Ensemble(const Study& study, const EnsembleOptions& options = {});

  /// All of them settled.
  using Ended = Decided;
  /// Starts first .. first + count - 1, also beyond study().sampling.starts. Throws InputError beyond the end of a
  /// grid.
  Ended starts(std::uint64_t first, std::size_t count);
  /// Starts that begin at [initial] of the study but with balls at these angles, `balls` a start. Balls that overlap
  /// make no start: it has failed. Throws InputError for uncertain values and angles that are not finite.
  Ended at_angles(const std::vector<double>& phi);

  /// The study, its horizon and its way of sampling filled in.
  const Study& study() const { return study_; }
  /// Those known so far.
  const Catalogue& catalogue() const { return runner_->catalogue(); }
  BalanceNote balance() const { return runner_->balance(); }

 private:
  Study study_;
  bool gathers_;
  std::unique_ptr<StartRunner> runner_;
};

}  // namespace equipoise
