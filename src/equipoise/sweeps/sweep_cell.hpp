// One cell of a sweep: an ensemble whose search begins with a neighbour's results.
#pragma once

#include <cstddef>
#include <functional>

#include "equipoise/results/sweep_result.hpp"
#include "equipoise/running/run_options.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"

namespace equipoise {

struct CellAtWork;
class CellDesk;
class EnsembleHelper;
class SearchLog;

/// The workers on a block. No result depends on them.
struct BlockWorkers {
  int threads = 1;
  std::function<int()> idle{};  ///< threads that are idle when a cell's search begins; empty: none
  CellDesk* desk = nullptr;     ///< where others decide starts of its cells; null: nobody does
  const StopFlag* stop = nullptr;
  SearchLog* notes = nullptr;  ///< of searches, or null
};

/// Computes the cells of a block one after another, skipping known ones. `known`: a cell that was done earlier, or
/// null; `deliver`: takes each new one. False if stopped.
bool run_block(const SweepPlan& plan, std::size_t block, const std::function<const SweepCell*(std::size_t)>& known,
               const std::function<void(std::size_t, SweepCell)>& deliver, const BlockWorkers& workers);

/// Decides starts of a cell that another process works on (sweeps/cell_desk.hpp). Its search begins where that
/// process's search began, and so finds the same. Check its stopped().
EnsembleHelper helper_for(const SweepPlan& plan, const CellAtWork& at, int threads, const StopFlag* stop);

}  // namespace equipoise
