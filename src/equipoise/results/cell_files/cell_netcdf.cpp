// Coordinates, columns and records of cells.
#include "equipoise/results/cell_files/cell_netcdf.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/results/commands/branches_result.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise::io {

namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::string variable_name(const std::string& key) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace

CellRecords::CellRecords(std::size_t cells, const std::function<std::vector<std::uint8_t>(std::size_t)>& record) {
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const std::vector<std::uint8_t> of_cell = record(cell);
    bytes.insert(bytes.end(), of_cell.begin(), of_cell.end());
    ends.push_back(static_cast<double>(bytes.size()));
  }
}

NetcdfFile::Mode CellRecords::mode() const {
  constexpr std::size_t most = (std::size_t{1} << 31) - 4;
  return bytes.size() > most ? NetcdfFile::Mode::create_large : NetcdfFile::Mode::create;
}

CellTable::CellTable(NetcdfFile& file, const std::vector<SweepAxis>& axes, const CellRecords& records)
    : file_(file), axes_(axes), records_(records) {
  for (const SweepAxis& axis : axes) {
    const bool zipped = axis.parameters.size() > 1;
    const std::string first = variable_name(axis.parameters.front().key);
    const int dimension = file_.dimension(zipped ? "step" : first, axis.size());
    dimensions_.push_back(dimension);
    for (const SweepParameter& p : axis.parameters) {
      const int variable = file_.variable(variable_name(p.key), NC_DOUBLE, {dimension}, p.unit.empty() ? "1" : p.unit,
                                          fmt::format("{}: {}", p.key, parameter_label(p.key)));
      coordinates_.emplace_back(variable, &p.values);
      if (zipped) along_ += (along_.empty() ? "" : " ") + variable_name(p.key);
    }
  }
}

void CellTable::column(const std::string& name, const std::string& units, const std::string& meaning,
                       const Values& values, int dimension, std::size_t width) {
  std::vector<int> dimensions = dimensions_;
  if (dimension >= 0) dimensions.push_back(dimension);
  const int variable = file_.variable(name, NC_DOUBLE, dimensions, units, meaning);
  file_.fill(variable, &no_value);
  if (!along_.empty()) file_.attribute(variable, "coordinates", along_);
  columns_.push_back({variable, dimension >= 0, width, values});
}

void CellTable::define_records() {
  const int bytes = file_.dimension("record_byte", std::max<std::size_t>(records_.bytes.size(), 1));
  const int cells = file_.dimension("cell", records_.ends.size());
  record_ = file_.variable("record", NC_BYTE, {bytes}, "1", words::files::records_of_cells);
  record_end_ = file_.variable("record_end", NC_DOUBLE, {cells}, "1", words::files::ends_of_records);
}

void CellTable::write() const {
  for (const auto& [variable, values] : coordinates_) file_.write(variable, {0}, {values->size()}, values->data());
  for (const Column& column : columns_) write_column(column);
  if (!records_.bytes.empty()) file_.write(record_, {0}, {records_.bytes.size()}, records_.bytes.data());
  file_.write(record_end_, {0}, {records_.ends.size()}, records_.ends.data());
}

void CellTable::write_column(const Column& column) const {
  std::vector<double> values(column.width);
  for (std::size_t cell = 0; cell < records_.ends.size(); ++cell) {
    if (!records_.has(cell)) continue;
    std::fill(values.begin(), values.end(), no_value);
    column.values(cell, values.data());
    std::vector<std::size_t> start = place_on(axes_, cell), count(start.size(), 1);
    if (column.wide) {
      start.push_back(0);
      count.push_back(column.width);
    }
    file_.write(column.variable, start, count, values.data());
  }
}

void define_cell_attributes(NetcdfFile& file, const std::string& kind, const std::string& title,
                            const std::string& identity, const Study& study, bool complete) {
  file.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  file.attribute(NC_GLOBAL, "title", title);
  file.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
  file.attribute(NC_GLOBAL, "kind", kind);
  file.attribute(NC_GLOBAL, "identity", identity);
  file.attribute(NC_GLOBAL, "study", to_toml(study));
  file.attribute(NC_GLOBAL, "complete", complete ? "yes" : "no");
}

}  // namespace equipoise::io
