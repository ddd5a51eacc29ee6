// A survey at work in this process: its blocks given to threads and to helping processes, its cells kept.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/sweeps/survey.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"

namespace equipoise {

/// Blocks come in one batch or in several; helpers stay for all of them. Who derives from it holds the cells in memory.
class SurveyRun {
 public:
  virtual ~SurveyRun() = default;  // who derives from it dismisses helpers first: they call what it overrides

  // For helpers, from any thread.
  /// A block that is not yet given out; none once all are, or the work is to stop.
  std::optional<std::size_t> next_block();
  CellRecord known(std::size_t cell) const;
  /// It is in the file, if there is one, when this returns.
  void deliver(std::size_t cell, const CellRecord& made);
  /// Nothing more is to come.
  bool idle() const { return over_; }

 protected:
  explicit SurveyRun(const SurveyOptions& options);

  /// Helpers are at work from here on. `file` keeps what is delivered; or null.
  void open(Survey survey, io::CellFile* file);
  /// As many blocks at a time as there are threads; where there are fewer, each has several threads. Threads for which
  /// no block is left decide starts of the others' cells. Helpers may still be at blocks when it returns.
  void work(std::vector<std::size_t> blocks);
  /// Nothing more is to come: returns when the helpers have gone. Throws what ended the work early; what is done is in
  /// the file.
  void close();
  void dismiss();  ///< the same, without throwing

  /// Blocks of the last batch that somebody took.
  std::span<const std::size_t> begun() const;
  /// Whether the stop flag ended the work, or something thrown.
  bool stopped() const { return is_set(options_.stop) || failed_; }

  // Called with taking_ held.
  virtual CellRecord record(std::size_t cell) const = 0;
  /// What the file is to keep of it. Empty: it is there already.
  virtual CellRecord take(std::size_t cell, const CellRecord& made) = 0;
  /// It is in the file.
  virtual void kept(std::size_t) {}

  const int threads_;
  std::function<bool()> out_of_time_;  // ends what is at work, not the run; set before open(). Empty: never
  mutable std::mutex taking_;
  std::condition_variable delivered_;  // a cell was taken

 private:
  void work_along(const BlockWorkers& workers);
  void help();
  void guarded(const std::function<void()>& call);

  const SurveyOptions& options_;
  Survey survey_;
  io::CellFile* file_ = nullptr;
  std::vector<std::size_t> blocks_;
  std::size_t next_ = 0;
  std::atomic<int> working_{0}, idle_{0};  // those at blocks; threads without one
  std::atomic<bool> over_{false}, failed_{false};
  OpenEnsembles ensembles_;
  std::mutex failing_;
  std::exception_ptr failure_;
  std::future<void> helpers_;
};

}  // namespace equipoise
