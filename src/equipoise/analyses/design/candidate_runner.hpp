// Makes the ensembles of candidates, for this process or another.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"

namespace equipoise {

/// An ensemble that is wanted.
struct WantedSample {
  std::vector<DesignSetting> settings;
  std::uint64_t starts = 0, seed = 0;
  bool whole = false;  ///< with a whole search for attractors, not a first look's
};

class CandidateRunner {
 public:
  /// Searches the study as it is.
  CandidateRunner(const DesignProblem& problem, const RunOptions& options);

  /// None if stopped. Thread-safe.
  std::optional<DesignSample> run(const WantedSample& wanted, int threads);

 private:
  // What a thread keeps of the final speeds it has met.
  struct Met {
    AttractorSearchCache searches;
    std::map<std::string, bool> balances;  // by attractor_search_subject(): whether a balanced state attracts
  };
  bool stopped() const { return is_set(options_.stop); }
  bool balances(const Study& study, Met& met) const;
  std::optional<DesignSample> run(const WantedSample& wanted, int threads, Met& met) const;

  const DesignProblem& problem_;
  const RunOptions& options_;
  // Of the study as it is: where the searches of all candidates begin.
  std::vector<std::vector<double>> warm_start_states_;
  WarmStartLevels warm_start_levels_;
  std::mutex taking_;
  std::vector<std::unique_ptr<Met>> free_;
};

/// What is wanted as a record, and back.
CellRecord record_of(const WantedSample& wanted);
WantedSample wanted_from(const CellRecord& record);

/// A block is a question: what is known of it is what is wanted, what is made of it the ensemble (KeptSample, unnamed).
Survey candidate_survey(const std::shared_ptr<CandidateRunner>& runner);

}  // namespace equipoise
