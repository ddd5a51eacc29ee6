// What the NetCDF files of sweeps and capacities share: parameters as coordinates, values by cell, each cell's record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/results/io/netcdf.hpp"

namespace equipoise::io {

/// Records that the program itself reads back (cell_file.hpp), one after the other, and their ends. Missing ones are
/// empty.
struct CellRecords {
  CellRecords(std::size_t cells, const std::function<std::vector<std::uint8_t>(std::size_t cell)>& record);

  bool has(std::size_t cell) const { return ends[cell] > (cell > 0 ? ends[cell - 1] : 0.0); }
  /// Files with 64-bit offsets, which any reader knows, hold variables of up to 2 GiB.
  NetcdfFile::Mode mode() const;

  std::vector<std::uint8_t> bytes;
  std::vector<double> ends;
};

/// A table over the cells of some axes in a new file. Define axes first, then columns and other content, then records
/// and attributes; call write() after end_definitions().
class CellTable {
 public:
  /// Writes the `width` values of a cell that has a record; they are NaN before.
  using Values = std::function<void(std::size_t cell, double* values)>;

  /// A coordinate for every parameter, one dimension per axis; zipped parameters along "step".
  CellTable(NetcdfFile& file, const std::vector<SweepAxis>& axes, const CellRecords& records);

  /// A variable by cell, and also by another dimension with `width` places if `dimension` is given.
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

/// Conventions, title, source, kind, identity, study, complete: attributes of every such file.
void define_cell_attributes(NetcdfFile& file, const std::string& kind, const std::string& title,
                            const std::string& identity, const Study& study, bool complete);

}  // namespace equipoise::io
