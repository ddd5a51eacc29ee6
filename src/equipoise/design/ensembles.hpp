// Ensembles of candidates: run, kept as they come, never run twice.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/attractor_search/attractor_search.hpp"
#include "equipoise/cell_files/design_file.hpp"
#include "equipoise/design/problem.hpp"
#include "equipoise/results/design_result.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/types/warm_start_levels.hpp"

namespace equipoise {

/// An ensemble that is wanted.
struct WantedSample {
  std::vector<DesignSetting> settings;
  std::uint64_t starts = 0, seed = 0;
};

/// What a design's search asks is asked again in the same order by another run of it: the number of a question names
/// its answer in the file. Not for several threads at once.
class DesignEnsembles {
 public:
  /// `file`: what an earlier run kept, or null.
  DesignEnsembles(const DesignProblem& problem, const RunOptions& options, DesignFile* file);

  /// In the order of `wanted`; candidates at once, threads shared among them. Throws SearchOver if stopped: what is
  /// done is kept, and known().
  std::vector<DesignSample> run(const std::vector<WantedSample>& wanted);

  /// What was run of it before, or null.
  const DesignSample* known(const WantedSample& wanted) const;

  std::uint64_t trajectories() const { return trajectories_; }  ///< followed, those of earlier runs included
  std::uint64_t resumed() const { return resumed_; }
  bool stopped() const { return is_set(options_.stop); }

 private:
  // What a thread keeps of the final speeds it has met.
  struct Met {
    AttractorSearchCache discoveries;
    std::map<std::string, bool> balances;  // by attractor_search_subject(): whether a balanced state attracts
  };
  void begin_with_study();
  bool balances(const Study& study, Met& met) const;
  /// Answers those of `wanted` that are `missing`, and takes them from there: what is left was not done.
  void work_off(const std::vector<WantedSample>& wanted, std::vector<std::size_t>& missing,
                std::vector<DesignSample>& samples);
  DesignSample one(const WantedSample& wanted, int threads, Met& met, bool& complete) const;

  const DesignProblem& problem_;
  const RunOptions& options_;
  DesignFile* file_;
  int threads_;
  // Of the study as it is: where the searches of all candidates begin.
  std::vector<std::vector<double>> seeds_;
  WarmStartLevels hints_;
  std::vector<Met> met_;  // one a thread
  std::map<std::string, DesignSample> known_;
  std::uint64_t asked_ = 0, trajectories_ = 0, resumed_ = 0;
};

}  // namespace equipoise
