// The file of a design: ensembles are kept as they come, the result is written whole at the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"

namespace equipoise {

/// A CellFile with ensembles as records. The results, `path`, are NetCDF (classic, 64-bit offsets), sealed: by ensemble
/// its starts, its figures with their intervals, and its candidate as text; by member of the front its figures on the
/// held-out starts. During the search, `path`.part holds every ensemble that the results lack.
class DesignFile {
 public:
  /// Opens existing parts of the same design, or begins anew. `most`: upper limit on the number of ensembles. Throws
  /// InputError if the file cannot be written, is in use, is damaged, or holds something else, and says which.
  DesignFile(const std::string& path, const std::string& identity, std::size_t most);

  /// The kept answer to question `number`, if it is the answer to this question.
  std::optional<DesignSample> sample(std::uint64_t number, const std::string& name) const;
  /// What damage has taken from the unfinished part, in words; empty if nothing.
  std::string loss() const { return file_.loss(); }
  /// On disk within about a second of work. If the disk cannot take it, throws RunError and keeps all earlier records.
  void append(std::uint64_t number, const std::string& name, const DesignSample& sample);
  /// Writes the results, if anything is new or there is no file. Throws RunError, with everything kept as it was.
  void finish(const DesignResult& result);

 private:
  std::size_t most_;
  std::map<std::uint64_t, KeptSample> samples_;
  io::CellFile file_;
};

}  // namespace equipoise
