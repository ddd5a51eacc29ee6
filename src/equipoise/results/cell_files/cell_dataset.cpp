// Coordinates, columns and records of cells.
#include "equipoise/results/cell_files/cell_dataset.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "equipoise/results/commands/branch.hpp"

namespace equipoise::io {

namespace {

std::string variable_name(const std::string& key) {
  std::string name = key;
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace

CellDataset::CellDataset(const std::string& title, const std::vector<SweepAxis>& axes, const CellRecords& records)
    : Dataset(title), records_(records) {
  for (const SweepAxis& axis : axes) {
    const bool zipped = axis.parameters.size() > 1;
    axes_.push_back(dimension(zipped ? "step" : variable_name(axis.parameters.front().key), axis.size()));
    for (const SweepParameter& p : axis.parameters) {
      add(variable_name(p.key), p.unit.empty() ? "1" : p.unit, fmt::format("{}: {}", p.key, parameter_label(p.key)),
          {axes_.back()}, [&p](std::size_t k) { return p.values[k]; });
      if (zipped) coordinates_ += (coordinates_.empty() ? "" : " ") + variable_name(p.key);
    }
  }
}

void CellDataset::by_cell(const std::string& name, const std::string& units, const std::string& meaning,
                          const CellValues& values, const std::vector<std::size_t>& along) {
  std::vector<std::size_t> all = axes_;
  all.insert(all.end(), along.begin(), along.end());
  const std::size_t width = along.empty() ? 1 : dimensions[along.front()].length;
  const auto value = [&records = records_, values, width](std::size_t place) {
    const std::size_t cell = place / width;
    return records.has(cell) ? values(cell, place % width) : no_number;
  };
  DataColumn& column = add(name, units, meaning, all, value);
  column.fill = no_number;
  if (!coordinates_.empty()) column.attributes.emplace_back("coordinates", coordinates_);
}

void CellDataset::add_records(const std::string& kind, const std::string& identity, const Study& study, bool complete) {
  const std::vector<std::uint8_t>& bytes = records_.bytes;
  const std::size_t byte = dimension("record_byte", std::max<std::size_t>(bytes.size(), 1));
  const std::size_t cell = dimension("cell", records_.ends.size());
  DataValues values;
  if (!bytes.empty()) values = [&bytes](std::size_t k) { return static_cast<std::int8_t>(bytes[k]); };
  add("record", "1", "all that is known of every cell, for the program (CBOR)", {byte}, values, DataColumn::Type::byte);
  add("record_end", "1", "where in record a cell ends, in bytes", {cell},
      [&ends = records_.ends](std::size_t k) { return ends[k]; });
  say("kind", kind);
  say("identity", identity);
  say("study", to_toml(study));
  say("complete", complete ? "yes" : "no");
}

}  // namespace equipoise::io
