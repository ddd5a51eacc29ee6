// Sweeps: an ensemble at every combination of some parameters' values.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "equipoise/results/sweep_result.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"

namespace equipoise {

class CellDesk;

/// Shared work: hands out blocks of cells and receives finished cells. Callable from any thread.
class SweepWork {
 public:
  virtual ~SweepWork() = default;
  /// A block that nobody works on yet; empty once all are handed out, or if the work is to stop.
  virtual std::optional<std::size_t> next_block() = 0;
  /// A cell that is already done, or null.
  virtual const SweepCell* known(std::size_t cell) const = 0;
  /// Receives a cell; when this returns, it is in the file, if there is one.
  virtual void deliver(std::size_t cell, SweepCell result) = 0;
  /// Nothing more will come from this process's own threads.
  virtual bool idle() const = 0;
  /// The desk for the cells that they work on.
  virtual CellDesk& desk() = 0;
};

/// Progress is in cells.
struct SweepOptions : RunOptions {
  std::string output;  ///< NetCDF file; an unfinished one of the same sweep is resumed, a finished one read
  /// Only every `shards`-th block, starting with number `shard`; other processes have the rest (sweeps/merge.hpp).
  std::size_t shard = 0, shards = 1;
  /// Called with every finished cell and its index, never from two threads at once.
  std::function<void(std::size_t, const SweepCell&)> cell;
  /// Runs beside this process's threads until everything is done: hands work to other processes.
  std::function<void(SweepWork&)> helpers;
};

/// Runs the ensembles. The result depends only on the plan. Throws InputError for unusable output files, RunError if
/// the output fails later.
SweepResult sweep(const SweepPlan& plan, const SweepOptions& options = {});

}  // namespace equipoise
