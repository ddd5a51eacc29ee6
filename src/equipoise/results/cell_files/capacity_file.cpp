// Capacities: one record per trial during the search, one per cell when it is known.
#include "equipoise/results/cell_files/capacity_file.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/results/cell_files/cell_netcdf.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace {

constexpr io::CellFileKind capacity_kind{"capacity", io::Journal::Kind::trial};

class CapacityWriter {
 public:
  CapacityWriter(io::NetcdfFile& file, const std::string& identity, const CapacityResult& result,
                 const io::CellRecords& records)
      : file_(file), identity_(identity), result_(result), table_(file, result.axes, records) {
    for (const auto& cell : result.cells)
      if (cell) most_trials_ = std::max(most_trials_, cell->trials.size());
  }

  void write() {
    define_boundaries();
    define_trials();
    table_.define_records();
    io::define_cell_attributes(
        file_, "capacity", fmt::format(words::files::capacity, result_.key, result_.at_least, result_.asked_of_one()),
        identity_, result_.study, result_.complete());
    file_.attribute(NC_GLOBAL, "of", result_.key);
    file_.end_definitions();
    table_.write();
  }

 private:
  std::string unit() const { return result_.unit.empty() ? "1" : result_.unit; }

  void by_cell(const char* name, const std::string& units, const std::string& meaning,
               double (*value)(const CapacityCell&)) {
    table_.column(name, units, meaning,
                  [this, value](std::size_t index, double* v) { *v = value(*result_.cells[index]); });
  }

  void define_boundaries() {
    const std::string& key = result_.key;
    table_.column("capacity", unit(),
                  fmt::format(words::files::capacity_of_cell, key, result_.at_least, result_.asked_of_one()),
                  [this](std::size_t index, double* v) {
                    if (const auto& value = result_.cells[index]->value) *v = *value;
                  });
    by_cell("capacity_low", unit(), fmt::format(words::files::share_still_kept, key),
            [](const CapacityCell& c) { return c.low; });
    by_cell("capacity_high", unit(), fmt::format(words::files::share_lost, key),
            [](const CapacityCell& c) { return c.high; });
    by_cell("always", "1", words::files::kept_in_whole_range,
            [](const CapacityCell& c) { return c.always ? 1.0 : 0.0; });
    by_cell("never", "1", words::files::lost_in_whole_range, [](const CapacityCell& c) { return c.never ? 1.0 : 0.0; });
    by_cell("trials", "1", "values tried", [](const CapacityCell& c) { return static_cast<double>(c.trials.size()); });
  }

  void define_trials() {
    const int trial = file_.dimension("trial", std::max<std::size_t>(most_trials_, 1));
    const auto by_trial = [&](const char* name, const std::string& units, const std::string& meaning,
                              double (*value)(const CapacityTrial&)) {
      table_.column(
          name, units, meaning,
          [this, value](std::size_t index, double* v) {
            for (const CapacityTrial& t : result_.cells[index]->trials) *v++ = value(t);
          },
          trial, std::max<std::size_t>(most_trials_, 1));
    };
    by_trial("trial_value", unit(), result_.key + ": value tried", [](const CapacityTrial& t) { return t.value; });
    by_trial("trial_starts", "1", "starts followed",
             [](const CapacityTrial& t) { return static_cast<double>(t.balanced.total); });
    by_trial("trial_share", "1", words::files::share_balanced, [](const CapacityTrial& t) { return t.balanced.share; });
    by_trial("trial_share_low", "1", words::files::lower_end,
             [](const CapacityTrial& t) { return t.unstable ? 0.0 : t.balanced.low; });
    by_trial("trial_share_high", "1", words::files::upper_end,
             [](const CapacityTrial& t) { return t.unstable ? 0.0 : t.balanced.high; });
    by_trial("trial_undecided", "1", words::files::share_undecided,
             [](const CapacityTrial& t) { return t.undecided.share; });
    by_trial("trial_unstable", "1", words::files::trial_unstable,
             [](const CapacityTrial& t) { return t.unstable ? 1.0 : 0.0; });
  }

  io::NetcdfFile& file_;
  const std::string& identity_;
  const CapacityResult& result_;
  io::CellTable table_;
  std::size_t most_trials_ = 0;
};

}  // namespace

namespace io {

std::unique_ptr<CellFile> open_capacity_file(const std::string& path, const std::string& identity,
                                             std::vector<std::vector<CapacityTrial>>& trials) {
  const auto take = [&trials](std::size_t cell, const std::vector<std::uint8_t>& record) {
    for (CapacityTrial& trial : trials_from(record)) trials[cell].push_back(std::move(trial));
  };
  return std::make_unique<CellFile>(capacity_kind, path, identity, trials.size(), take);
}

void finish_capacity_file(CellFile& file, const CapacityResult& result) {
  const auto write = [&](const std::string& path, const std::string& identity) {
    const CellRecords records(result.cells.size(), [&](std::size_t index) {
      const auto& cell = result.cells[index];
      return cell ? bytes_of(cell->trials) : std::vector<std::uint8_t>{};
    });
    write_netcdf_file(
        path, [&](NetcdfFile& netcdf) { CapacityWriter(netcdf, identity, result, records).write(); }, records.mode());
  };
  file.finish(write, result.complete() ? CellFile::Rest::nothing : CellFile::Rest::all);
}

}  // namespace io
}  // namespace equipoise
