// Sweeps: one record a cell.
#include "equipoise/store/sweep_file.hpp"

#include <optional>
#include <utility>

#include "equipoise/store/cell_file.hpp"
#include "equipoise/store/result_identity.hpp"
#include "equipoise/store/sweep_cells.hpp"
#include "equipoise/store/sweep_netcdf.hpp"

namespace equipoise {

namespace {

constexpr store::CellFileKind sweep_kind{"sweep", store::Journal::Kind::cell, "results of this sweep",
                                         "must be a new file, or results of the same sweep",
                                         "holds no sweep; must be what \"sweep -o\" wrote"};

// The last record of a cell counts.
store::CellFile::Take taken_into(SweepCells& cells) {
  return [&cells](std::size_t index, const std::vector<std::uint8_t>& record) {
    if (cells.size() <= index) cells.resize(index + 1);
    std::optional<SweepCell> cell = store::cell_from(record.data(), record.size());
    cells[index] = cell ? std::make_shared<SweepCell>(std::move(*cell)) : nullptr;
  };
}

}  // namespace

struct SweepFile::State {
  SweepCells cells;
  store::CellFile file;
};

SweepFile::SweepFile(const std::string& path, const std::string& identity, std::size_t cells) {
  SweepCells there(cells);
  store::CellFile file(sweep_kind, path, identity, cells, taken_into(there));
  state_ = std::make_unique<State>(State{std::move(there), std::move(file)});
}

SweepFile::~SweepFile() = default;

SweepCells SweepFile::take_cells() { return std::move(state_->cells); }

void SweepFile::append(std::size_t index, const SweepCell& cell) { state_->file.append(index, store::bytes_of(cell)); }

Notes& SweepFile::notes() { return state_->file.notes(); }

void SweepFile::finish(const SweepResult& result) {
  state_->file.finish(
      [&](const std::string& path, const std::string& identity) { store::write_sweep_netcdf(path, identity, result); },
      result.complete() ? store::CellFile::Rest::nothing : store::CellFile::Rest::notes);
}

void write_sweep_file(const std::string& path, const SweepResult& result) {
  store::write_sweep_netcdf(store::path_for_whole_results(path), result.identity, result);
}

StoredSweep read_sweep(const std::string& path) {
  StoredSweep sweep;
  sweep.identity = store::read_cell_file(sweep_kind, path, taken_into(sweep.cells));
  return sweep;
}

}  // namespace equipoise
