// Sweeps: one record per cell.
#include "equipoise/results/cell_files/sweep_file.hpp"

#include <optional>
#include <utility>

#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/cell_files/sweep_netcdf.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

constexpr io::CellFileKind sweep_kind{"sweep", io::Journal::Kind::cell};

// The last record of a cell counts.
template <class Cells>
io::CellFile::Take taken_into(Cells& cells) {
  return [&cells](std::size_t index, const std::vector<std::uint8_t>& record) {
    cells[index] = std::make_shared<SweepCell>(io::cell_from(record));
  };
}

}  // namespace

void write_sweep_file(const std::string& path, const SweepResult& result) {
  io::write_sweep_netcdf(io::path_for_whole_results(path), result.identity, result);
}

StoredSweep read_sweep(const std::string& path) {
  StoredSweep sweep;
  sweep.identity = io::read_cell_file(sweep_kind, path, taken_into(sweep.cells));
  return sweep;
}

namespace io {

std::unique_ptr<CellFile> open_sweep_file(const std::string& path, const std::string& identity, SweepCells& cells) {
  return std::make_unique<CellFile>(sweep_kind, path, identity, cells.size(), taken_into(cells));
}

void finish_sweep_file(CellFile& file, const SweepResult& result) {
  file.finish([&](const std::string& path, const std::string& identity) { write_sweep_netcdf(path, identity, result); },
              result.complete() ? CellFile::Rest::nothing : CellFile::Rest::notes);
}

}  // namespace io
}  // namespace equipoise
