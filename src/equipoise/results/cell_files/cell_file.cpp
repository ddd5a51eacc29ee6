// Records of cells: finished results in NetCDF, new ones in a journal.
#include "equipoise/results/cell_files/cell_file.hpp"

#include <limits>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise::io {

namespace {

Store::Words words_of(const CellFileKind& kind) {
  return {fmt::format("results of this {}", kind.name),
          fmt::format("must be a new file, or results of the same {}", kind.name)};
}

}  // namespace

CellFile::CellFile(const CellFileKind& kind, const std::string& path, const std::string& identity, std::size_t cells,
                   const Take& take)
    : Store(path, identity, words_of(kind)), kind_(kind) {
  read_all(cells, take);
}

CellFile::CellFile(const CellFileKind& kind, const std::string& path, const Take& take)
    : Store(path, words_of(kind)), kind_(kind) {
  reading([&] {
    if (results() && results()->attribute("kind") != kind.name)
      throw InputError(path, "", "", fmt::format("holds no {0}; must be what \"{0} -o\" wrote", kind.name));
  });
  const std::size_t none = results() ? results()->length("cell") : std::numeric_limits<std::size_t>::max();
  read_all(IdentityLines(this->identity()).cells().value_or(none), take);
}

void CellFile::read_all(std::size_t cells, const Take& take) {
  reading([&] {
    if (!results()) return;
    if (const std::size_t there = results()->length("cell"); there != cells)
      refuse(path(), fmt::format("is damaged: it holds {} cells instead of {}", there, cells));
    read_results(take);
  });
  for (const Journal::Record& record : records()) {
    if (record.kind != kind_.record) refuse(part(), "holds something else");
    if (record.first >= cells)
      refuse(part(), fmt::format("is damaged: it holds a cell {} of {} cells", record.first, cells));
    take_sound(part(), take, record.first, payload<std::vector<std::uint8_t>>(record));
    changed_ = true;
  }
}

void CellFile::take_sound(const std::string& file, const Take& take, std::size_t cell,
                          const std::vector<std::uint8_t>& record) const {
  try {
    take(cell, record);
  } catch (const RunError& e) {
    refuse(file, fmt::format("is damaged: record {}: {}", cell + 1, e.what()));
  }
}

void CellFile::read_results(const Take& take) const {
  const std::size_t cells = results()->length("cell"), size = results()->length("record_byte");
  const std::vector<double> ends = read_column(*results(), "record_end", DataColumn::Type::real, {cells});
  const int records = results()->variable("record", netcdf_type(DataColumn::Type::byte), {size});
  std::size_t begin = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (!(ends[cell] >= static_cast<double>(begin) && ends[cell] <= static_cast<double>(size)))
      refuse(path(), "is damaged");
    const auto end = static_cast<std::size_t>(ends[cell]);
    if (end == begin) continue;
    std::vector<std::uint8_t> record(end - begin);
    results()->read(records, {begin}, {record.size()}, record.data());
    take_sound(path(), take, cell, record);
    begin = end;
  }
}

void CellFile::append(std::size_t cell, const std::vector<std::uint8_t>& record) {
  Store::append({.kind = kind_.record, .first = cell, .count = 1}, record.data(), record.size());
  changed_ = true;
}

void CellFile::finish(const std::function<void(const std::string&)>& write, Rest rest) {
  if (changed_ || !results()) return Store::finish(write, rest);
  if (rest == Rest::nothing) forget();
}

}  // namespace equipoise::io
