// A file of cells: records are kept as they come, results are written whole at the end.
// This room: files of surveys, cell by cell.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/io/store.hpp"

namespace equipoise::io {

/// A kind of cell file.
struct CellFileKind {
  const char* name;                                        ///< "sweep": attribute of the finished file, and in messages
  Journal::Kind record;                                    ///< kind of record in the unfinished file
  void (*check)(const std::vector<std::uint8_t>& record);  ///< throws RunError unless it is one of its records
};
inline constexpr CellFileKind sweep_kind{"sweep", Journal::Kind::cell, [](const auto& r) { (void)cell_from(r); }};
inline constexpr CellFileKind capacity_kind{"capacity", Journal::Kind::trial,
                                            [](const auto& r) { (void)trials_from(r); }};
inline constexpr CellFileKind design_kind{"design", Journal::Kind::ensemble,
                                          [](const auto& r) { (void)sample_from(r); }};
inline constexpr std::array cell_file_kinds{sweep_kind, capacity_kind, design_kind};

/// A store of records, one or more per cell. The finished results also hold each cell's record (cell_dataset.hpp),
/// in addition to what others read.
class CellFile : public Store {
 public:
  using Take = std::function<void(std::size_t cell, const std::vector<std::uint8_t>& record)>;

  /// Opens existing parts of the same results, or begins again. `take` receives every record found, those of the
  /// finished file first. Throws like Store.
  CellFile(const CellFileKind& kind, const std::string& path, const std::string& identity, std::size_t cells,
           const Take& take);
  /// Only reads a file of results or its unfinished part. Throws InputError for other or damaged files; a cell beyond
  /// the grid of the identity is damage.
  CellFile(const CellFileKind& kind, const std::string& path, const Take& take);

  void append(std::size_t cell, const std::vector<std::uint8_t>& record);
  /// Lets `write` write the results, if any record is new or there is no file. Throws like Store.
  void finish(const std::function<void(const std::string& path)>& write, Rest rest);

 private:
  void read_all(std::size_t cells, const Take& take);
  void read_results(const Take& take) const;
  void take_sound(const std::string& file, const Take& take, std::size_t cell,
                  const std::vector<std::uint8_t>& record) const;

  const CellFileKind kind_;
  bool changed_ = false;
};

// The finished files are NetCDF (classic, 64-bit offsets), sealed. Every variable has units and long_name, and missing
// cells are filled. All open_...() throw like CellFile, and put what is known in their last argument.

/// Records are cells. The file: write_sweep_file().
std::unique_ptr<CellFile> open_sweep_file(const std::string& path, const std::string& identity, SweepCells& cells);
/// Only searches of missing cells stay in the unfinished part.
void finish_sweep_file(CellFile& file, const SweepResult& result);

/// Records are trials, one or more. The file: a coordinate for every parameter, one dimension per axis; by cell the
/// capacity, its interval, and whether it lies beyond the range; by cell and trial the value, the balanced share with
/// its interval, and the undecided share.
std::unique_ptr<CellFile> open_capacity_file(const std::string& path, const std::string& identity,
                                             std::vector<std::vector<CapacityTrial>>& trials);
/// While cells are missing, their trials stay in the unfinished part.
void finish_capacity_file(CellFile& file, const CapacityResult& result);

/// Records are ensembles, at most `most`. The file: by ensemble its starts, its figures with their intervals, and its
/// candidate as text; by member of the front its figures on the held-out starts.
std::unique_ptr<CellFile> open_design_file(const std::string& path, const std::string& identity, std::size_t most,
                                           KeptSamples& kept);
/// Of a partial design, the ensembles stay in the unfinished part.
void finish_design_file(CellFile& file, const DesignResult& result, std::size_t most, const KeptSamples& kept);

}  // namespace equipoise::io
