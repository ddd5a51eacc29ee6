// The paper's tables computed row by row, with rows that an earlier run stored taken from there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/literature/reproduction.hpp"

namespace equipoise {

/// Which speed laws to compute ramps under. Constant speeds know no difference.
enum class LawChoice { published, kinematic, both };

struct ReproduceProgress {
  std::uint64_t done = 0, total = 0;  ///< starts, of all ensembles asked for
  std::string what;                   ///< the ensemble at work: "table-3-t0-25, kinematic"
};

struct ReproduceOptions {
  std::vector<int> tables;  ///< 1 to 7
  LawChoice laws = LawChoice::both;
  std::uint64_t starts = 0;  ///< a row; 0: as many as the paper used
  int threads = 0;           ///< 0: all cores
  /// Folder for every ensemble's per-start outcomes (one NetCDF file each); empty: none. Finished ensembles found there
  /// are not computed again, unfinished ones are resumed.
  std::string folder;
  const StopFlag* stop = nullptr;
  std::function<void(const ReproduceProgress&)> progress;
};

/// Computes and judges the tables asked for. After a stop, rows not done are marked so. Throws as basin() does.
std::vector<ReproducedTable> reproduce_tables(const ReproduceOptions& options);

}  // namespace equipoise
