// A file of cells: records are kept as they come, results are written whole at the end.
// This room: files of surveys, cell by cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/io/journal.hpp"

namespace equipoise::io {

/// A kind of cell file.
struct CellFileKind {
  const char* name;      ///< "sweep": attribute of the finished file, and in messages
  Journal::Kind record;  ///< kind of record in the unfinished file
};

/// Two files, as for an ensemble (basin_file.hpp). The results, `path`, are NetCDF, sealed; besides what others read
/// they hold each cell's record (cell_dataset.hpp). Until then `path`.part holds records, one or more per cell.
class CellFile {
 public:
  using Take = std::function<void(std::size_t cell, const std::vector<std::uint8_t>& record)>;

  /// Opens existing parts of the same results, or begins anew. `take` receives every record found, those of the
  /// finished file first. Throws InputError if the file cannot be written, is in use, is damaged, or holds something
  /// else.
  CellFile(const CellFileKind& kind, const std::string& path, const std::string& identity, std::size_t cells,
           const Take& take);

  /// On disk within about a second of work. If the disk cannot take it, throws RunError and keeps all earlier records.
  void append(std::size_t cell, const std::vector<std::uint8_t>& record);
  /// What damage has taken from the unfinished part, in words; empty if nothing.
  std::string loss() const { return journal_->loss(); }
  /// The search log of earlier runs that did not finish.
  SearchLog& notes() { return *notes_; }
  /// What stays of the unfinished part beside the results.
  enum class Rest {
    nothing,  ///< they are complete
    notes,    ///< they hold every record
    all       ///< the unfinished part holds more than they do
  };
  /// Lets `write` write the results, if any record is new or there is no file. Throws RunError and keeps everything.
  void finish(const std::function<void(const std::string& path, const std::string& identity)>& write, Rest rest);

 private:
  CellFileKind kind_;
  std::string path_, identity_;
  std::unique_ptr<Journal> journal_;
  std::unique_ptr<SearchLog> notes_;
  bool changed_ = false;
};

/// Reads the records of a file of results or of its unfinished part; returns the identity. Throws InputError for other
/// or damaged files.
std::string read_cell_file(const CellFileKind& kind, const std::string& path, const CellFile::Take& take);

}  // namespace equipoise::io
