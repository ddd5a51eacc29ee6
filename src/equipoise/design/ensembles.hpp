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

/// An ensemble to be run.
struct WantedSample {
  std::vector<DesignSetting> settings;
  std::uint64_t starts = 0, seed = 0;
};

/// Another run of a design's search asks the same questions in the same order: the number of a question identifies its
/// answer in the file. Not thread-safe.
class DesignEnsembles {
 public:
  /// `file`: answers kept by an earlier run, or null.
  DesignEnsembles(const DesignProblem& problem, const RunOptions& options, DesignFile* file);

  /// Results in the order of `wanted`; candidates run in parallel and share the threads. Throws SearchOver if stopped;
  /// finished samples are kept, see known().
  std::vector<DesignSample> run(const std::vector<WantedSample>& wanted);

  /// An earlier sample of it, or null.
  const DesignSample* known(const WantedSample& wanted) const;

  std::uint64_t trajectories() const { return trajectories_; }  ///< trajectories followed, including earlier runs
  std::uint64_t resumed() const { return resumed_; }
  bool stopped() const { return is_set(options_.stop); }

 private:
  // A thread's knowledge of the final speeds it has met.
  struct Met {
    AttractorSearchCache discoveries;
    std::map<std::string, bool> balances;  // by attractor_search_subject(): whether a balanced state attracts
  };
  void begin_with_study();
  bool balances(const Study& study, Met& met) const;
  /// Answers those of `wanted` that are `missing`, and removes them from there; the rest was not done.
  void work_off(const std::vector<WantedSample>& wanted, std::vector<std::size_t>& missing,
                std::vector<DesignSample>& samples);
  DesignSample one(const WantedSample& wanted, int threads, Met& met, bool& complete) const;

  const DesignProblem& problem_;
  const RunOptions& options_;
  DesignFile* file_;
  int threads_;
  // Of the original study: starting points for the searches of all candidates.
  std::vector<std::vector<double>> seeds_;
  WarmStartLevels hints_;
  std::vector<Met> met_;  // one per thread
  std::map<std::string, DesignSample> known_;
  std::uint64_t asked_ = 0, trajectories_ = 0, resumed_ = 0;
};

}  // namespace equipoise
