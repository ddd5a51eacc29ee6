// Surveys: ensembles in many cells, computed block by block by threads and processes that share them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"

namespace equipoise {

class CellDesk;
class EnsembleHelper;
class SearchLog;
struct CellAtWork;

/// What is kept of a cell and sent between processes (results/cell_files/sweep_cells.hpp). Empty: nothing.
using CellRecord = std::vector<std::uint8_t>;

/// Who works on a block, and where its cells come from and go to. No result depends on it.
struct BlockWorkers {
  int threads = 1;
  std::function<int()> idle{};  ///< threads that have nothing else to do when a cell's search begins; empty: none
  CellDesk* desk = nullptr;     ///< where others decide starts of its cells; null: nobody does
  const StopFlag* stop = nullptr;
  SearchLog* notes = nullptr;                                          ///< of searches, or null
  std::function<CellRecord(std::size_t cell)> known{};                 ///< what was made of a cell earlier
  std::function<void(std::size_t cell, const CellRecord&)> deliver{};  ///< takes what is new
};

/// What any process of a job can compute of it. Refers to what it was made from.
struct Survey {
  /// Computes what is not known of a block's cells. False if stopped.
  std::function<bool(std::size_t block, const BlockWorkers& workers)> run_block;
  /// Decides starts of a cell that another process has at its desk: it searches as that one does, from where that
  /// began, and so finds the same. Ask stopped() of it. Empty where no cell lies at a desk.
  std::function<EnsembleHelper(const CellAtWork& at, int threads, const StopFlag* stop)> helper_for;
};

/// Work to share: gives out blocks and takes what is made of their cells. Callable from any thread.
class SurveyWork {
 public:
  virtual ~SurveyWork() = default;
  /// A block that nobody works on yet; none once all are given out or the work is to stop.
  virtual std::optional<std::size_t> next_block() = 0;
  virtual CellRecord known(std::size_t cell) const = 0;
  /// It is in the file, if there is one, when this returns.
  virtual void deliver(std::size_t cell, const CellRecord& made) = 0;
  /// Nothing more is to come from this process' own threads.
  virtual bool idle() const = 0;
  /// Where the cells lie that they work on.
  virtual CellDesk& desk() = 0;
};

/// Runs beside the own threads until all is done: hands work to other processes. Empty: there are none.
using SurveyHelpers = std::function<void(const Survey&, SurveyWork&)>;

}  // namespace equipoise
