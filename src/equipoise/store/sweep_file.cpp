// Sweeps: finished results in NetCDF, new cells in a journal.
#include "equipoise/store/sweep_file.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/base/error.hpp"
#include "equipoise/files/journal.hpp"
#include "equipoise/files/netcdf.hpp"
#include "equipoise/files/sealed_file.hpp"
#include "equipoise/store/result_identity.hpp"
#include "equipoise/store/sweep_cells.hpp"
#include "equipoise/store/sweep_netcdf.hpp"

namespace equipoise {

namespace {

constexpr const char* this_sweep = "results of this sweep";
constexpr const char* same_sweep = "must be a new file, or results of the same sweep";

std::shared_ptr<SweepCell> shared(std::optional<SweepCell> cell) {
  return cell ? std::make_shared<SweepCell>(std::move(*cell)) : nullptr;
}

// The cells of a finished file into those that are missing.
void read_results(const std::string& path, const store::NetcdfFile& file, SweepCells& cells) {
  const std::size_t count = file.length("cell"), size = file.length("record_byte");
  if (cells.empty()) cells.resize(count);
  if (count != cells.size()) throw InputError(path, "", "", fmt::format("holds {} cells; {}", count, same_sweep));
  std::vector<double> ends(count);
  file.read(file.variable("record_end", NC_DOUBLE, {count}), {0}, {count}, ends.data());
  std::vector<std::uint8_t> bytes(size);
  file.read(file.variable("record", NC_BYTE, {size}), {0}, {size}, bytes.data());
  std::size_t begin = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto end = static_cast<std::size_t>(ends[k]);
    if (end < begin || end > size) throw InputError(path, "", "", fmt::format("is damaged; {}", same_sweep));
    if (end > begin && !cells[k]) cells[k] = shared(store::cell_from(bytes.data() + begin, end - begin));
    begin = end;
  }
}

void read_journal(const std::string& path, const store::Journal& journal, SweepCells& cells) {
  for (const store::Journal::Record& record : journal.records()) {
    if (record.kind != store::Journal::Kind::cell)
      throw InputError(path, "", "", fmt::format("is of no sweep; {}", same_sweep));
    if (cells.size() <= record.first) cells.resize(record.first + 1);
    std::vector<std::uint8_t> bytes(record.bytes);
    journal.read(record, 0, bytes.size(), bytes.data());
    cells[record.first] = shared(store::cell_from(bytes.data(), bytes.size()));
  }
}

void require_whole(const std::string& path) {
  if (const std::string damage = store::why_not_whole(path); !damage.empty())
    throw InputError(path, "", "", fmt::format("{}; {}", damage, same_sweep));
}

}  // namespace

struct SweepFile::State {
  std::string path, identity;
  SweepCells cells;
  bool changed = false;
  std::optional<store::Journal> journal;
};

SweepFile::SweepFile(const std::string& path, const std::string& identity, std::size_t cells)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = store::results_path(path, same_sweep);
  s.identity = identity;
  s.cells.resize(cells);
  s.journal.emplace(s.path + ".part", s.path, identity);
  if (std::filesystem::exists(s.path)) {
    require_whole(s.path);
    const store::NetcdfFile file(s.path, store::NetcdfFile::Mode::read);
    store::require_same(file.attribute("identity"), identity, s.path, this_sweep, same_sweep);
    read_results(s.path, file, s.cells);
  }
  store::require_same(s.journal->identity(), identity, s.path + ".part", this_sweep, same_sweep);
  read_journal(s.path + ".part", *s.journal, s.cells);
  if (s.cells.size() != cells)
    throw InputError(s.path + ".part", "", "", fmt::format("holds other cells; {}", same_sweep));
  s.changed = !s.journal->records().empty();
}

SweepFile::~SweepFile() = default;

SweepCells SweepFile::take_cells() { return std::move(state_->cells); }

void SweepFile::append(std::size_t index, const SweepCell& cell) {
  const std::vector<std::uint8_t> bytes = store::bytes_of(cell);
  state_->journal->append({.kind = store::Journal::Kind::cell, .first = index, .count = 1}, bytes.data(), bytes.size());
  state_->changed = true;
}

void SweepFile::finish(const SweepResult& result) {
  if (!state_->changed && std::filesystem::exists(state_->path)) return;
  store::write_sweep_netcdf(state_->path, state_->identity, result);
  state_->journal->remove();
}

void write_sweep_file(const std::string& path, const SweepResult& result) {
  store::write_sweep_netcdf(store::path_for_whole_results(path), result.identity, result);
}

StoredSweep read_sweep(const std::string& path) {
  StoredSweep sweep;
  if (path.ends_with(".part")) {
    const store::Journal journal(path, path, "");
    sweep.identity = journal.identity();
    read_journal(path, journal, sweep.cells);
    return sweep;
  }
  require_whole(path);
  const store::NetcdfFile file(path, store::NetcdfFile::Mode::read);
  if (file.attribute("kind") != "sweep")
    throw InputError(path, "", "", "holds no sweep; must be what \"sweep -o\" wrote");
  sweep.identity = file.attribute("identity");
  read_results(path, file, sweep.cells);
  return sweep;
}

}  // namespace equipoise
