// The file of whatever has cells: kept as they come, written whole in the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/io/journal.hpp"
#include "equipoise/running/search_log.hpp"

namespace equipoise::io {

/// What is kept in such a file.
struct CellFileKind {
  const char* name;      ///< "sweep": attribute of the finished file, and of messages
  Journal::Kind record;  ///< of the unfinished one
};

/// Two files, as of an ensemble (basin_file.hpp). The results, `path`, are NetCDF, sealed, and hold beside what others
/// read each cell's record (cell_netcdf.hpp). While work goes on, `path`.part holds records as they come, one or more a
/// cell.
class CellFile {
 public:
  using Take = std::function<void(std::size_t cell, const std::vector<std::uint8_t>& record)>;

  /// Opens what there is of the same results, or begins anew; `take` is given every record that was there, those of the
  /// finished file first. Throws InputError if it cannot be written, is in use, damaged, or holds something else:
  /// which, it says.
  CellFile(const CellFileKind& kind, const std::string& path, const std::string& identity, std::size_t cells,
           const Take& take);

  /// On disk within about a second of work. Throws RunError, with all before it kept, if the disk cannot take it.
  void append(std::size_t cell, const std::vector<std::uint8_t>& record);
  /// Of the searches for attractors in its cells, as far as runs came that did not finish.
  SearchLog& notes() { return *notes_; }
  /// What of the unfinished part stays beside results.
  enum class Rest {
    nothing,  ///< they are complete
    notes,    ///< they hold every record
    all       ///< records hold more than they do
  };
  /// Has the results written by `write`, if any record is new or there is no file. Throws RunError, with everything
  /// kept as it was.
  void finish(const std::function<void(const std::string& path, const std::string& identity)>& write, Rest rest);

 private:
  CellFileKind kind_;
  std::string path_, identity_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<SearchLog> notes_;
  bool changed_ = false;
};

/// The records of a file of results or of its unfinished part; returns whose they are. Throws InputError if it is
/// neither or damaged.
std::string read_cell_file(const CellFileKind& kind, const std::string& path, const CellFile::Take& take);

}  // namespace equipoise::io
