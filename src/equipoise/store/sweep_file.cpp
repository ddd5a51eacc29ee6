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

constexpr store::CellFileKind sweep_kind{"sweep", store::Journal::Kind::cell};

// The last record of a cell counts.
store::CellFile::Take taken_into(SweepCells& cells) {
  return [&cells](std::size_t index, const std::vector<std::uint8_t>& record) {
    if (cells.size() <= index) cells.resize(index + 1);
    std::optional<SweepCell> cell = store::cell_from(record);
    cells[index] = cell ? std::make_shared<SweepCell>(std::move(*cell)) : nullptr;
  };
}

}  // namespace

void write_sweep_file(const std::string& path, const SweepResult& result) {
  store::write_sweep_netcdf(store::path_for_whole_results(path), result.identity, result);
}

StoredSweep read_sweep(const std::string& path) {
  StoredSweep sweep;
  sweep.identity = store::read_cell_file(sweep_kind, path, taken_into(sweep.cells));
  return sweep;
}

namespace store {

std::unique_ptr<CellFile> open_sweep_file(const std::string& path, const std::string& identity, SweepCells& cells) {
  return std::make_unique<CellFile>(sweep_kind, path, identity, cells.size(), taken_into(cells));
}

void finish_sweep_file(CellFile& file, const SweepResult& result) {
  file.finish([&](const std::string& path, const std::string& identity) { write_sweep_netcdf(path, identity, result); },
              result.complete() ? CellFile::Rest::nothing : CellFile::Rest::notes);
}

}  // namespace store
}  // namespace equipoise
