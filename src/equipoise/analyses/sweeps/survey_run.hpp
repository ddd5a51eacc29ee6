// A survey at work in this process: its blocks given to threads and to helping processes.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/analyses/sweeps/open_ensembles.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/core/running/run_options.hpp"

namespace equipoise {

/// Who derives from it keeps what is made.
class SurveyRun : public SurveyWork {
 public:
  std::optional<std::size_t> next_block() override;
  bool idle() const override { return working_ == 0; }

 protected:
  explicit SurveyRun(const RunOptions& options);

  /// As many blocks at a time as there are threads; where there are fewer, each has several threads. Threads for which
  /// no block is left decide starts of the others' cells. Returns what ended the work early, if anything was thrown.
  std::exception_ptr work(const Survey& survey, std::vector<std::size_t> blocks, SearchLog* notes,
                          const SurveyHelpers& helpers);
  /// Blocks that somebody took.
  std::span<const std::size_t> begun() const;

  const int threads_;

 private:
  bool stopped() const { return is_set(stop_) || failed_; }
  void work_along(const Survey& survey, const BlockWorkers& workers);
  void help();
  void guarded(const std::function<void()>& call);

  const StopFlag* stop_;
  std::vector<std::size_t> blocks_;
  std::atomic<std::size_t> next_{0};
  std::atomic<int> working_{0}, idle_{0};  // those at blocks; threads without one
  OpenEnsembles ensembles_;
  std::atomic<bool> failed_{false};
  std::mutex failing_;
  std::exception_ptr failure_;
};

}  // namespace equipoise
