// What the NetCDF files of sweeps and capacities share: parameters as coordinates, values by cell, each cell's record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/io/netcdf.hpp"
#include "equipoise/results/sweep_result.hpp"

namespace equipoise::io {

/// What the program itself reads back of every cell (cell_file.hpp), one behind the other, and where each ends; one
/// that is missing takes no room.
struct CellRecords {
  CellRecords(std::size_t cells, const std::function<std::vector<std::uint8_t>(std::size_t cell)>& record);

  bool has(std::size_t cell) const { return ends[cell] > (cell > 0 ? ends[cell - 1] : 0.0); }
  /// Files with 64-bit offsets, which any reader knows, hold variables of up to 2 GiB.
  NetcdfFile::Mode mode() const;

  std::vector<std::uint8_t> bytes;
  std::vector<double> ends;
};

/// A table over the cells of some axes in a file that is being made: axes first, then columns and what else its owner
/// defines, then records and attributes; after end_definitions() write().
class CellTable {
 public:
  /// Writes the values of a cell that has a record, `width` of them, which are not-a-number before.
  using Values = std::function<void(std::size_t cell, double* values)>;

  /// A coordinate for every parameter along one dimension an axis; zipped ones along "step".
  CellTable(NetcdfFile& file, const std::vector<SweepAxis>& axes, const CellRecords& records);

  /// A variable by cell, and by another dimension of `width` places if `dimension` is one.
  void column(const std::string& name, const std::string& units, const std::string& meaning, const Values& values,
              int dimension = -1, std::size_t width = 1);
  void define_records();
  void write() const;

 private:
  struct Column {
    int variable = -1;
    bool wide = false;
    std::size_t width = 1;
    Values values;
  };
  void write_column(const Column& column) const;

  NetcdfFile& file_;
  const std::vector<SweepAxis>& axes_;
  const CellRecords& records_;
  std::vector<int> dimensions_;
  std::vector<std::pair<int, const std::vector<double>*>> coordinates_;
  std::vector<Column> columns_;
  std::string along_;  // coordinates of zipped parameters
  int record_ = -1, record_end_ = -1;
};

/// Conventions, title, source, kind, identity, study, complete: what every such file says of itself.
void define_cell_attributes(NetcdfFile& file, const std::string& kind, const std::string& title,
                            const std::string& identity, const Study& study, bool complete);

}  // namespace equipoise::io
