// The starts of a study in any order, at any time, after one attractor search.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/columns/transient_figures.hpp"
#include "equipoise/results/types/fate.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

struct EnsembleOptions : RunOptions {
  bool transients = false;  ///< gather every start's transient
  SearchMode search = SearchMode::full;
  AttractorSearchCache* searches = nullptr;  ///< shared by consecutive ensembles with the same final speed
};

/// Decides starts by their indices, and the caller's own states, bit for bit as basin() does. For callers that show
/// results as they come; basin() counts, stores and resumes. Use one from one thread only.
///
/// A motion that the search missed is listed once a start comes to it. Unless its identifier is reserved, it gets the
/// next free one (from first_free_id), in the order in which starts are requested.
class Ensemble {
 public:
  /// Searches for attractors, with the progress of basin(). Throws InputError for studies that basin() would not
  /// decide, RunError if stopped.
  explicit Ensemble(const Study& study, const EnsembleOptions& options = {});

  /// Fates that are final: unlisted motions have been listed.
  using Ended = Decided;
  /// Decides starts first .. first + count - 1, even beyond study().sampling.starts. Throws InputError beyond a grid.
  Ended starts(std::uint64_t first, std::size_t count);
  /// Decides starts at the study's [initial], but with these ball angles, `balls` a start. A start with overlapping
  /// balls has failed. Throws InputError for uncertain values, or angles that are not finite.
  Ended at_angles(const std::vector<double>& phi);

  /// The study, with its horizon and sampling method filled in.
  const Study& study() const { return study_; }
  /// The attractors known so far.
  const Catalogue& catalogue() const { return catalogue_; }
  BalanceNote balance() const { return session_.balance(); }

 private:
  Study study_;
  bool gathers_;
  Session session_;
  RunCatalogue catalogue_;
};

}  // namespace equipoise
