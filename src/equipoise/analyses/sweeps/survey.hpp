// Surveys: ensembles in many cells, computed block by block by threads and processes that share the blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/core/running/run_options.hpp"

namespace equipoise {

class OpenEnsembles;
class SearchLog;
class SurveyRun;
struct BasinOptions;

/// What is kept of a cell and sent between processes (results/cell_files/sweep_cells.hpp). Empty: nothing.
using CellRecord = std::vector<std::uint8_t>;

/// Who works on a block, and where its cells come from and go to. No result depends on it.
struct BlockWorkers {
  int threads = 1;
  std::function<int()> idle{};    ///< threads that have nothing else to do when a cell's search begins; empty: none
  OpenEnsembles* help = nullptr;  ///< idle threads, which decide starts of its cells; or null
  const StopFlag* stop = nullptr;
  std::function<bool()> stop_asked{};                                  ///< the same by polling; empty: never
  SearchLog* notes = nullptr;                                          ///< of searches, or null
  std::function<CellRecord(std::size_t cell)> known{};                 ///< what was made of a cell earlier
  std::function<void(std::size_t cell, const CellRecord&)> deliver{};  ///< takes what is new

  /// Puts them to work on a cell's ensemble.
  void work_on(BasinOptions& ensemble) const;
};

/// What any process of a job can compute of it: what is not known of a block's cells. False if stopped. Refers to what
/// it was made from.
using Survey = std::function<bool(std::size_t block, const BlockWorkers& workers)>;

/// Runs next to the own threads until all is done: hands blocks to other processes. Empty: there are none.
using SurveyHelpers = std::function<void(SurveyRun&)>;

/// Progress is in cells.
struct SurveyOptions : RunOptions {
  std::string output;  ///< NetCDF file; an unfinished one of the same survey is resumed, a finished one read
  SurveyHelpers helpers;
};

}  // namespace equipoise
