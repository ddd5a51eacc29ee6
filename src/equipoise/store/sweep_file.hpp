// The file of a sweep: cells kept as they come, written whole in the end.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

class Notes;

/// Two files, as of an ensemble (basin_file.hpp). The results, `path`, are NetCDF (classic, 64-bit offsets), sealed: a
/// coordinate for every parameter, along one dimension an axis; outcome kinds with code, name and alias; count, share
/// and its interval, mean decision time and figures of the motion by cell and outcome; quantiles of the transients and
/// shares above limits by cell; cells that are missing are filled. Every variable has units and long_name. While work
/// goes on, and while cells are missing, `path`.part holds every cell that is done.
class SweepFile {
 public:
  /// Opens what there is of the same sweep, or begins anew. `identity`: SweepPlan::identity(). Throws InputError if it
  /// cannot be written, is in use, damaged, or holds something else: which, it says.
  SweepFile(const std::string& path, const std::string& identity, std::size_t cells);
  ~SweepFile();
  SweepFile(const SweepFile&) = delete;
  SweepFile& operator=(const SweepFile&) = delete;

  /// Those that were there when it was opened.
  SweepCells take_cells();
  /// On disk within about a second of work. Throws RunError, with all before it kept, if the disk cannot take it.
  void append(std::size_t index, const SweepCell& cell);
  /// Of the searches for attractors, as far as runs came that did not finish.
  Notes& notes();
  /// Writes the results, if any cell is new or there is no file; of the unfinished part only searches of
  /// missing ones stay. Throws RunError, with everything kept as it was.
  void finish(const SweepResult& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Writes `path` anew from a sweep in memory: what sweep() with that output would have left there. Throws InputError if
/// unfinished results stand beside it, RunError, with an old file as it was, if the disk cannot take it.
void write_sweep_file(const std::string& path, const SweepResult& result);

/// Which sweep a file of results or its unfinished part is of, and what it holds. Throws InputError if it is neither or
/// damaged.
struct StoredSweep {
  std::string identity;
  SweepCells cells;
};
StoredSweep read_sweep(const std::string& path);

}  // namespace equipoise
