// Capacities as text, JSON and CSV.
#include "equipoise/reports/capacity_report.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "equipoise/base/plain_number.hpp"
#include "equipoise/base/version.hpp"
#include "equipoise/text/cell_text.hpp"
#include "equipoise/text/computed.hpp"
#include "equipoise/text/csv.hpp"
#include "equipoise/text/sensitivity_report.hpp"
#include "equipoise/text/text.hpp"

namespace equipoise {

namespace {

using Json = nlohmann::ordered_json;

std::string four_digits(double value) { return plain_number(value, 4); }

std::string in_unit(const CapacityResult& r, const std::string& value) {
  return r.unit.empty() ? value : value + " " + r.unit;
}

// "20 to 400 g mm"
std::string sought_text(const CapacityResult& r) {
  return in_unit(r, fmt::format("{} to {}", four_digits(r.from), four_digits(r.to)));
}

// For a cell that was begun and not finished.
std::string open_row(const OpenCapacity& open, std::size_t width) {
  const auto end = [](const std::optional<double>& value) { return value ? four_digits(*value) : std::string("?"); };
  return fmt::format("{:>{}}  {:<24}{:>7}\n", "open", width, fmt::format("{} and {}", end(open.low), end(open.high)),
                     open.trials);
}

}  // namespace

std::string capacity_value_text(const CapacityResult& r, const CapacityCell& cell) {
  if (cell.never) return "below " + four_digits(r.from);
  if (cell.always) return "above " + four_digits(r.to);
  return four_digits(*cell.value);
}

std::string capacity_text(const CapacityResult& r) {
  std::vector<std::string> set = keys_of(r.axes);
  set.push_back(r.key);
  std::string text = study_heading(r.study) + uncertain_text(r.study, set);
  const std::string asked = column_title(r.key, r.unit);
  const std::size_t width = std::max<std::size_t>(asked.size(), 12);
  text += fmt::format("The largest {} at which {:.4g} % of starts end balanced, looked for from {}.\n\n", r.key,
                      100.0 * r.at_least, sought_text(r));
  text += column_titles(r.axes) + fmt::format("{:>{}}  {:<24}{:>7}\n", asked, width, "surely between", "trials");
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    if (r.open[index]) text += column_values(r.axes, index) + open_row(*r.open[index], width);
    if (!r.cells[index]) continue;
    const CapacityCell& cell = *r.cells[index];
    text += column_values(r.axes, index);
    text += fmt::format("{:>{}}  {:<24}{:>7}\n", capacity_value_text(r, cell), width,
                        fmt::format("{} and {}", four_digits(cell.low), four_digits(cell.high)), cell.trials.size());
  }
  text += fmt::format(
      "\nSurely between: up to the first value the share is as large with 95 % confidence, whatever undecided starts "
      "would come to; at the second it is smaller with 95 % confidence. Located to {}; a share that falls short "
      "between two of the values tried and recovers is not seen.\n",
      in_unit(r, four_digits(r.precision * (r.to - r.from))));
  if (!r.complete())
    text +=
        "PARTIAL: stopped before all cells were done. Of an open one the capacity is not known between the two "
        "values; ?: no value tried says so.\n";
  if (r.resumed_trials > 0) text += fmt::format("{} trials from an earlier run. ", r.resumed_trials);
  return text + fmt::format("{} starts a trial, seed {}, the same ones in all; {}; equipoise {}\n", r.starts,
                            r.study.sampling.seed, computed_text(r), version_string);
}

std::string capacity_json(const CapacityResult& r) {
  Json json{{"of", r.key}, {"unit", r.unit}, {"at_least", r.at_least}, {"from", r.from}, {"to", r.to}};
  json["over"] = over_json(r.axes);
  json["partial"] = !r.complete();
  json["cells"] = Json::array();
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    if (!r.cells[index]) continue;
    const CapacityCell& cell = *r.cells[index];
    Json trials = Json::array();
    for (const CapacityTrial& t : cell.trials) {
      Json one{{"value", t.value}};
      one.update(share_json(t.balanced));
      one["undecided"] = t.undecided.share;
      one["unstable"] = t.unstable;
      trials.push_back(one);
    }
    json["cells"].push_back({{"at", at_json(r.axes, index)},
                             {"value", cell.value ? Json(*cell.value) : Json(nullptr)},
                             {"low", cell.low},
                             {"high", cell.high},
                             {"always", cell.always},
                             {"never", cell.never},
                             {"trials", trials}});
  }
  json["open"] = Json::array();
  const auto or_null = [](const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); };
  for (std::size_t index = 0; index < r.open.size(); ++index)
    if (const auto& open = r.open[index])
      json["open"].push_back({{"at", at_json(r.axes, index)},
                              {"low", or_null(open->low)},
                              {"high", or_null(open->high)},
                              {"trials", open->trials}});
  json["confidence"] = 0.95;
  json["starts"] = r.starts;
  json["resumed_trials"] = r.resumed_trials;
  add_computed(json, r);
  return json.dump(2) + "\n";
}

std::string capacity_csv(const CapacityResult& r) {
  std::string text = fmt::format(
      "# equipoise {}: largest {} at which a share of {} of {} starts ends balanced, looked for from {}{}\n",
      version_string, r.key, r.at_least, r.starts, sought_text(r), r.complete() ? "" : ", PARTIAL");
  text += csv_study(r.study) + csv_titles(r.axes) + csv_title(r.key, r.unit) + ",low,high,always,never,trials\n";
  for (std::size_t index = 0; index < r.cells.size(); ++index) {
    if (!r.cells[index]) continue;
    const CapacityCell& cell = *r.cells[index];
    text += csv_values(r.axes, index);
    text += fmt::format("{},{},{},{},{},{}\n", cell.value ? fmt::format("{}", *cell.value) : "", cell.low, cell.high,
                        cell.always ? 1 : 0, cell.never ? 1 : 0, cell.trials.size());
  }
  return text;
}

}  // namespace equipoise
