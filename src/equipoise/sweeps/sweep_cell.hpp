// One cell of a sweep: an ensemble that begins its search where a neighbour's ended.
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

/// Who works on a block. No result depends on it.
struct BlockWorkers {
  int threads = 1;
  std::function<int()> idle{};  ///< threads that have nothing else to do when a cell's search begins; empty: none
  CellDesk* desk = nullptr;     ///< where others decide starts of its cells; null: nobody does
  const StopFlag* stop = nullptr;
  SearchLog* notes = nullptr;  ///< of searches, or null
};

/// Computes the cells of a block one after another, those that are known already left out. `known`: a cell that was
/// done earlier, or null; `deliver`: takes each new one. False if stopped.
bool run_block(const SweepPlan& plan, std::size_t block, const std::function<const SweepCell*(std::size_t)>& known,
               const std::function<void(std::size_t, SweepCell)>& deliver, const BlockWorkers& workers);

/// Decides starts of a cell that another process works on (sweeps/cell_desk.hpp). It searches as that one does, from
/// where that began, and so finds the same. Ask stopped() of it.
EnsembleHelper helper_for(const SweepPlan& plan, const CellAtWork& at, int threads, const StopFlag* stop);

}  // namespace equipoise
