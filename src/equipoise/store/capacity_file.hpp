// The file of capacities: trials kept as they come, written whole in the end.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/results/capacity_result.hpp"

namespace equipoise {

class Notes;

/// Two files, as of a sweep (sweep_file.hpp). The results, `path`, are NetCDF (classic, 64-bit offsets), sealed: a
/// coordinate for every parameter, along one dimension an axis; by cell the capacity, its interval, whether it lies
/// beyond the range; by cell and trial the value, the balanced share with its interval and the undecided one; cells
/// that are missing are filled. Every variable has units and long_name. While cells are missing, `path`.part holds
/// every trial that the results do not.
class CapacityFile {
 public:
  /// Opens what there is of the same capacity, or begins anew. `identity`: all that decides what stands in the results.
  /// Throws InputError if it cannot be written, is in use, damaged, or holds something else: which, it says.
  CapacityFile(const std::string& path, const std::string& identity, std::size_t cells);
  ~CapacityFile();
  CapacityFile(const CapacityFile&) = delete;
  CapacityFile& operator=(const CapacityFile&) = delete;

  /// By cell, those that were there when it was opened.
  std::vector<std::vector<CapacityTrial>> take_trials();
  /// On disk within about a second of work. Throws RunError, with all before it kept, if the disk cannot take it.
  void append(std::size_t cell, const CapacityTrial& trial);
  /// Of the searches for attractors, as far as runs came that did not finish.
  Notes& notes();
  /// Writes the results, if any trial is new or there is no file. Throws RunError, with everything kept as it was.
  void finish(const CapacityResult& result);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
