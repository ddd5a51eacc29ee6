// Records of cells: finished results in NetCDF, new ones in a journal.
#include "equipoise/results/cell_files/cell_file.hpp"

#include <filesystem>
#include <system_error>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/words/core.hpp"
#include "equipoise/results/io/kept_search_log.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/sealed_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise::io {

namespace {

std::string same_results(const CellFileKind& kind) { return fmt::format(words::files::same_results_or_new, kind.name); }

[[noreturn]] void refuse(const CellFileKind& kind, const std::string& path, const std::string& problem) {
  throw InputError(path, "", "", fmt::format("{}; {}", problem, same_results(kind)));
}

void require_these(const CellFileKind& kind, const std::string& there, const std::string& here, const std::string& of) {
  require_same(there, here, of, fmt::format("results of this {}", kind.name), same_results(kind));
}

void take_sound(const CellFileKind& kind, const std::string& path, const CellFile::Take& take, std::size_t cell,
                const std::vector<std::uint8_t>& record) {
  try {
    take(cell, record);
  } catch (const RunError& e) {
    refuse(kind, path, fmt::format(words::files::record_of_cell, cell + 1, e.what()));
  }
}

void read_results(const CellFileKind& kind, const std::string& path, const NetcdfFile& file,
                  const CellFile::Take& take) {
  const std::size_t cells = file.length("cell"), size = file.length("record_byte");
  std::vector<double> ends(cells);
  file.read(file.variable("record_end", NC_DOUBLE, {cells}), {0}, {cells}, ends.data());
  const int records = file.variable("record", NC_BYTE, {size});
  std::size_t begin = 0;
  for (std::size_t cell = 0; cell < cells; ++cell) {
    if (!(ends[cell] >= static_cast<double>(begin) && ends[cell] <= static_cast<double>(size)))
      refuse(kind, path, "is damaged");
    const auto end = static_cast<std::size_t>(ends[cell]);
    if (end == begin) continue;
    std::vector<std::uint8_t> record(end - begin);
    file.read(records, {begin}, {record.size()}, record.data());
    take_sound(kind, path, take, cell, record);
    begin = end;
  }
}

void read_journal(const CellFileKind& kind, const std::string& path, const Journal& journal,
                  const CellFile::Take& take) {
  for (const Journal::Record& record : journal.records()) {
    if (record.kind == Journal::Kind::note) continue;
    if (record.kind != kind.record) refuse(kind, path, words::files::something_else);
    std::vector<std::uint8_t> bytes(record.bytes);
    journal.read(record, 0, bytes.size(), bytes.data());
    take_sound(kind, path, take, record.first, bytes);
  }
}

template <class Read>
auto with_results(const CellFileKind& kind, const std::string& path, const Read& read) {
  if (const std::string damage = why_not_whole(path); !damage.empty()) refuse(kind, path, damage);
  try {
    return read(NetcdfFile(path, NetcdfFile::Mode::read, "it"));
  } catch (const RunError& e) {
    refuse(kind, path, fmt::format(words::files::damaged_within, e.what()));
  }
}

}  // namespace

CellFile::CellFile(const CellFileKind& kind, const std::string& path, const std::string& identity, std::size_t cells,
                   const Take& take)
    : kind_(kind), path_(results_path(path, same_results(kind))), identity_(identity) {
  const std::string part = path_ + ".part";
  journal_ = std::make_unique<Journal>(part, path_, identity);
  if (std::filesystem::exists(path_)) {
    with_results(kind, path_, [&](const NetcdfFile& file) {
      require_these(kind, file.attribute("identity"), identity, path_);
      if (const std::size_t there = file.length("cell"); there != cells)
        refuse(kind, path_, fmt::format("holds {} cells", there));
      read_results(kind, path_, file, take);
    });
  }
  require_these(kind, journal_->identity(), identity, part);
  for (const Journal::Record& record : journal_->records()) {
    if (record.kind == Journal::Kind::note) continue;
    if (record.first >= cells) refuse(kind, part, "holds other cells");
    changed_ = true;
  }
  read_journal(kind, part, *journal_, take);
  notes_ = notes_kept_in(*journal_);
}

void CellFile::append(std::size_t cell, const std::vector<std::uint8_t>& record) {
  journal_->append({.kind = kind_.record, .first = cell, .count = 1}, record.data(), record.size());
  changed_ = true;
}

void CellFile::finish(const std::function<void(const std::string&, const std::string&)>& write, Rest rest) {
  if (!changed_ && std::filesystem::exists(path_)) {
    if (rest == Rest::nothing) journal_->remove();
    return;
  }
  journal_->require_sound();
  write(path_, identity_);
  if (rest != Rest::all) leave_notes(*journal_, rest == Rest::nothing);
}

std::string read_cell_file(const CellFileKind& kind, const std::string& path, const CellFile::Take& take) {
  if (std::error_code ignored; !std::filesystem::exists(path, ignored))
    throw InputError(path, "", "", words::core::no_file);
  if (path.ends_with(".part")) {
    const Journal journal(path);
    read_journal(kind, path, journal, take);
    return journal.identity();
  }
  return with_results(kind, path, [&](const NetcdfFile& file) {
    if (file.attribute("kind") != kind.name)
      throw InputError(path, "", "", fmt::format(words::files::other_command, kind.name));
    read_results(kind, path, file, take);
    return file.attribute("identity");
  });
}

}  // namespace equipoise::io
