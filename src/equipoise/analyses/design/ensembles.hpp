// Ensembles of candidates: run, kept as they come, never run twice.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "equipoise/analyses/design/candidate_runner.hpp"
#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/cell_files/design_file.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// What a design's search asks is asked again in the same order by another run of it: the number of a question names
/// its answer in the file. One thread asks; other processes may help to answer.
class DesignEnsembles final : public SurveyWork {
 public:
  /// `file`: what an earlier run kept, or null.
  DesignEnsembles(const DesignProblem& problem, const RunOptions& options, DesignFile* file,
                  const SurveyHelpers& helpers = {}, std::function<bool()> search_time = {});
  ~DesignEnsembles() override;

  /// Results in the order of `wanted`; candidates run in parallel and share the threads. Throws SearchOver if stopped;
  /// finished samples are kept, see known().
  std::vector<DesignSample> run(const std::vector<WantedSample>& wanted);
  /// Nothing more is asked: helpers go home.
  void end();

  /// An earlier sample of it, or null.
  const DesignSample* known(const WantedSample& wanted) const;

  std::uint64_t trajectories() const { return trajectories_; }  ///< trajectories followed, including earlier runs
  std::uint64_t resumed() const { return resumed_; }
  bool stopped() const { return is_set(options_.stop); }
  /// From now on only the stop flag ends the work: the search is over.
  void after_search();
  /// Whether the search has had its time. It has not before something is known: without a candidate the rest of the
  /// time would be of no use.
  bool out_of_time() const { return searching_ && some_known_ && search_time_ && search_time_(); }

  std::optional<std::size_t> next_block() override;
  CellRecord known(std::size_t number) const override;
  void deliver(std::size_t number, const CellRecord& made) override;
  bool idle() const override { return over_; }

 private:
  void watch_time();
  void end_clock();
  void work_off(std::size_t missing);
  void fail(std::exception_ptr thrown);

  const RunOptions& options_;
  DesignFile* file_;
  std::function<bool()> search_time_;
  // What a running candidate heeds: also set when the search has had its time, so that one costly candidate cannot take
  // the time of the checks as well.
  StopFlag cut_{false};
  RunOptions candidate_options_;
  std::atomic<bool> searching_{true}, some_known_{false};
  std::atomic<bool> over_{false};
  std::thread clock_;
  int threads_;
  Survey survey_;
  std::map<std::string, DesignSample> known_;
  std::uint64_t trajectories_ = 0, resumed_ = 0;

  mutable std::mutex taking_;
  std::condition_variable answered_;
  std::uint64_t asked_ = 0;  // before these:
  std::vector<WantedSample> batch_;
  std::vector<std::optional<DesignSample>> answers_;
  std::size_t next_ = 0;
  std::exception_ptr failure_;  // the first, of threads or of helpers
  std::future<void> helpers_;
};

}  // namespace equipoise
