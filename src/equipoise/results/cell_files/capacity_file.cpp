// Capacities: one record per trial during the search, one per cell when it is known.
#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "equipoise/results/cell_files/cell_dataset.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/io/dataset_file.hpp"

namespace equipoise {

namespace {

void add_boundaries(io::CellDataset& data, const std::string& unit, const CapacityResult& result) {
  const auto add = [&](const char* name, const std::string& units, const std::string& meaning,
                       double (*value)(const CapacityCell&)) {
    data.by_cell(name, units, meaning,
                 [&result, value](std::size_t cell, std::size_t) { return value(*result.cells[cell]); });
  };
  add("capacity", unit,
      fmt::format("{}: the largest at which a share of {} of the starts {}", result.key, result.at_least,
                  result.asked_of_one()),
      [](const CapacityCell& c) { return c.value.value_or(no_number); });
  add("capacity_low", unit, fmt::format("{}: up to here the share is as large with 95 % confidence", result.key),
      [](const CapacityCell& c) { return c.low; });
  add("capacity_high", unit, fmt::format("{}: here the share is smaller with 95 % confidence", result.key),
      [](const CapacityCell& c) { return c.high; });
  add("always", "1", "1: the share is as large up to the end of the range",
      [](const CapacityCell& c) { return c.always ? 1.0 : 0.0; });
  add("never", "1", "1: the share is smaller over the whole range",
      [](const CapacityCell& c) { return c.never ? 1.0 : 0.0; });
  add("trials", "1", "values tried", [](const CapacityCell& c) { return static_cast<double>(c.trials.size()); });
}

void add_trials(io::CellDataset& data, const std::string& unit, const CapacityResult& result) {
  std::size_t most = 1;
  for (const auto& cell : result.cells)
    if (cell) most = std::max(most, cell->trials.size());
  const std::size_t trial = data.dimension("trial", most);
  const auto add = [&](const char* name, const std::string& units, const std::string& meaning,
                       double (*value)(const CapacityTrial&)) {
    const auto of_trial = [&result, value](std::size_t cell, std::size_t k) {
      const std::vector<CapacityTrial>& trials = result.cells[cell]->trials;
      return k < trials.size() ? value(trials[k]) : no_number;
    };
    data.by_cell(name, units, meaning, of_trial, {trial});
  };
  add("trial_value", unit, result.key + ": value tried", [](const CapacityTrial& t) { return t.value; });
  add("trial_starts", "1", "starts followed",
      [](const CapacityTrial& t) { return static_cast<double>(t.balanced.total); });
  add("trial_share", "1", "share of the starts that " + result.asked(),
      [](const CapacityTrial& t) { return t.balanced.share; });
  add("trial_share_low", "1", io::lower_end, [](const CapacityTrial& t) { return t.unstable ? 0.0 : t.balanced.low; });
  add("trial_share_high", "1", io::upper_end,
      [](const CapacityTrial& t) { return t.unstable ? 0.0 : t.balanced.high; });
  add("trial_undecided", "1", "share of the starts that stay undecided",
      [](const CapacityTrial& t) { return t.undecided.share; });
  add("trial_unstable", "1", "1: no balanced state attracts, and no start was followed",
      [](const CapacityTrial& t) { return t.unstable ? 1.0 : 0.0; });
}

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
  const auto write = [&](const std::string& path) {
    const CellRecords records(result.cells, [](const CapacityCell& cell) { return bytes_of(cell.trials); });
    CellDataset data(fmt::format("Largest {} at which a share of {} of the starts {}", result.key, result.at_least,
                                 result.asked_of_one()),
                     result.axes, records);
    const std::string unit = result.unit.empty() ? "1" : result.unit;
    add_boundaries(data, unit, result);
    add_trials(data, unit, result);
    data.add_records("capacity", file.identity(), result.study, result.complete());
    data.say("of", result.key);
    write_netcdf_file(path, data);
  };
  file.finish(write, result.complete() ? CellFile::Rest::nothing : CellFile::Rest::all);
}

}  // namespace io
}  // namespace equipoise
