// What the files of sweeps, capacities and designs share: parameters, values by cell, each cell's record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise::io {

/// The meanings of columns with the ends of a share's interval.
inline constexpr char lower_end[] = "lower end of its 95 % interval";
inline constexpr char upper_end[] = "upper end of its 95 % interval";

/// Records that the program itself reads back (cell_file.hpp), one after the other, and their ends. Missing ones are
/// empty.
struct CellRecords {
  /// `cells`: pointers, null where a cell is missing; `record(cell)`: its bytes.
  template <class Cells, class Record>
  CellRecords(const Cells& cells, const Record& record) {
    for (const auto& cell : cells) {
      const auto of_cell = cell ? record(*cell) : std::vector<std::uint8_t>{};
      bytes.insert(bytes.end(), of_cell.begin(), of_cell.end());
      ends.push_back(static_cast<double>(bytes.size()));
    }
  }

  bool has(std::size_t cell) const { return ends[cell] > (cell > 0 ? ends[cell - 1] : 0.0); }

  std::vector<std::uint8_t> bytes;
  std::vector<double> ends;
};

/// Begins with a coordinate for every parameter, one dimension per axis; zipped parameters along "step".
struct CellDataset : Dataset {
  /// The `k`-th of the values of a cell that has a record; not-a-number where it has none.
  using CellValues = std::function<double(std::size_t cell, std::size_t k)>;

  CellDataset(const std::string& title, const std::vector<SweepAxis>& axes, const CellRecords& records);

  /// One value per cell, or as many as the dimension at `along` has places, which follows those of the axes.
  void by_cell(const std::string& name, const std::string& units, const std::string& meaning, const CellValues& values,
               const std::vector<std::size_t>& along = {});
  /// To be called last: the records, and what such files say of themselves.
  void add_records(const std::string& kind, const std::string& identity, const Study& study, bool complete);

 private:
  const CellRecords& records_;
  std::vector<std::size_t> axes_;
  std::string coordinates_;  ///< of zipped parameters
};

}  // namespace equipoise::io
