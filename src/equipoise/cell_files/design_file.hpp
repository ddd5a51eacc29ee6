// The file of a design: ensembles kept as they come, the answer written whole in the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "equipoise/cell_files/cell_file.hpp"
#include "equipoise/cell_files/sweep_cells.hpp"

namespace equipoise {

/// A CellFile, whose records are ensembles. The results, `path`, are NetCDF (classic, 64-bit offsets), sealed: by
/// ensemble its starts, its figures with their intervals and its candidate as text; by member of the front its figures
/// on the held-out starts. While the search goes on, `path`.part holds every ensemble that the results do not.
class DesignFile {
 public:
  /// Opens what there is of the same design, or begins anew. `most`: ensembles that there may be. Throws InputError if
  /// it cannot be written, is in use, damaged, or holds something else: which, it says.
  DesignFile(const std::string& path, const std::string& identity, std::size_t most);

  /// Of the `number`-th question, if what was kept is the answer to it.
  std::optional<DesignSample> sample(std::uint64_t number, const std::string& name) const;
  /// On disk within about a second of work. Throws RunError, with all before it kept, if the disk cannot take it.
  void append(std::uint64_t number, const std::string& name, const DesignSample& sample);
  /// Writes the results, if anything is new or there is no file. Throws RunError, with everything kept as it was.
  void finish(const DesignResult& result);

 private:
  std::size_t most_;
  std::map<std::uint64_t, KeptSample> samples_;
  io::CellFile file_;
};

}  // namespace equipoise
