// Which tables are distributions, and what is wrong with them.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/toml/toml_tree.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

namespace {

bool names_distribution(const StudyValue& table) {
  return std::any_of(distribution_names.begin(), distribution_names.end(),
                     [&](const char* name) { return table.find(name); });
}

// Reads one distribution, entry by entry.
class DistributionReader {
 public:
  DistributionReader(const StudyFile& file, std::string key, const StudyValue& table) : file_(file), table_(table) {
    value_.key = std::move(key);
  }

  UncertainValue read() {
    find_kind();
    value_.numbers = entries(distribution_names[static_cast<std::size_t>(value_.kind)]);
    check_numbers();
    read_between();
    return std::move(value_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(file_.where(value_.key, &table_), shown_text(value_.key), shown(table_), problem);
  }

  void find_kind() {
    bool found = false;
    for (std::size_t k = 0; k < distribution_names.size(); ++k) {
      if (!table_.find(distribution_names[k])) continue;
      if (std::exchange(found, true)) fail(fmt::format("has two distributions; must be one of {}", distribution_forms));
      value_.kind = static_cast<DistributionKind>(k);
    }
    for (const auto& [name, entry] : *table_.table())
      if (name != distribution_names[static_cast<std::size_t>(value_.kind)] && name != "between")
        fail(fmt::format("has an unknown entry \"{}\"; must be {}", shown_text(name), distribution_forms));
  }

  std::vector<double> entries(const std::string& name) {
    const StudyValue::Array* array = table_.find(name)->array();
    if (!array || array->empty()) fail(fmt::format("{} must be an array of numbers", name));
    std::vector<double> numbers;
    for (const StudyValue& entry : *array) numbers.push_back(number(name, entry, numbers.size() + 1));
    return numbers;
  }

  // A plain number, or the number of a quantity; all entries share one unit.
  double number(const std::string& name, const StudyValue& entry, std::size_t place) {
    double result = entry.number();
    std::string unit;
    if (const std::string* text = entry.string()) {
      const NumberAndUnit parts = split_quantity(*text);
      if (parts.error != std::errc()) fail(fmt::format("{} entry {} does not begin with a number", name, place));
      result = parts.number;
      unit = parts.unit;
      if (unit.empty())
        fail(fmt::format("{} entry {} has no unit; must be a number, or a number with a unit", name, place));
    } else if (!entry.is_number()) {
      fail(fmt::format("{} entry {} is not a number; must be a finite number, or a quantity with its unit", name,
                       place));
    }
    if (!any_number.contains(result)) fail(fmt::format("{} entry {} must be {}", name, place, any_number.text()));
    if (!std::exchange(has_unit_, true))
      value_.unit = unit;
    else if (value_.unit != unit)
      fail(fmt::format("{} entry {} has another unit than the entries before; all must have the same unit", name,
                       place));
    return result;
  }

  void check_numbers() const {
    const std::vector<double>& n = value_.numbers;
    const char* name = distribution_names[static_cast<std::size_t>(value_.kind)];
    if (value_.kind == DistributionKind::values) return;
    const bool normal = value_.kind == DistributionKind::normal;
    if (n.size() != 2)
      fail(fmt::format("{} has {} entries; must have two, {}", name, n.size(),
                       normal ? "[mean, standard deviation]" : "[low, high]"));
    if (normal && n[1] < 0.0) fail("the standard deviation must be 0 or more");
    if (!normal && n[0] > n[1])
      fail(fmt::format("{} bounds out of order; must be [low, high] with low at most high", name));
    if (value_.kind == DistributionKind::loguniform && !(n[0] > 0.0)) fail("loguniform bounds must be greater than 0");
  }

  void read_between() {
    if (!table_.find("between")) return;
    if (value_.kind != DistributionKind::normal) fail("between can be used only with normal");
    const std::vector<double> bounds = entries("between");
    if (bounds.size() != 2 || !(bounds[0] < bounds[1]))
      fail("between must be two numbers, [low, high] with low less than high");
    const double mean = value_.numbers[0], reach = farthest * value_.numbers[1];
    if (!(bounds[1] > mean - reach) || !(bounds[0] < mean + reach))
      fail(fmt::format("between must begin or end within {} standard deviations of the mean", farthest));
    value_.between = {bounds[0], bounds[1]};
  }

  // Beyond this, a normal distribution has a negligible probability of 10^-89.
  static constexpr double farthest = 20.0;

  const StudyFile& file_;
  const StudyValue& table_;
  UncertainValue value_;
  bool has_unit_ = false;
};

}  // namespace

bool takes_distributions(const std::string& dotted) {
  return std::any_of(key_tables().begin(), key_tables().end(),
                     [&](const KeyTable& table) { return table.drawn() && table.name == dotted; });
}

namespace {
void take_from(const StudyFile& file, const KeyTable& keys, const std::string& path,
               std::vector<UncertainValue>& values) {
  const StudyValue* table = file.root.find_path(path);
  if (!table || !table->table()) return;
  for (const auto& [key, value] : *table->table()) {
    if (!names_distribution(value)) continue;
    const std::string dotted = path + "." + key;
    // A key in quotes may contain dots; the reader knows no such key.
    if (file.root.find_path(dotted) != &value || takes_distributions(dotted)) continue;
    UncertainValue& read = values.emplace_back(DistributionReader(file, dotted, value).read());
    const Key* line = keys.find(key, true);
    if (!line || line->dimension != Dimension::angle) continue;
    const Measured unit = measure("1 " + read.unit, {Dimension::angle});
    read.turn = read.unit.empty() ? two_pi : unit.problem.empty() ? two_pi / unit.value : 0.0;
  }
}
}  // namespace

std::vector<UncertainValue> take_uncertain(StudyFile& file) {
  std::vector<UncertainValue> values;
  for (const KeyTable& keys : key_tables())
    if (keys.drawn())
      for (const std::string& path : paths_of(file.root, keys.name)) take_from(file, keys, path, values);
  for (const UncertainValue& value : values) {
    StudyValue& taken = file.taken[value.key] = value.written(value.taken());
    taken.set_line(file.root.find_path(value.key)->line());
  }
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  return values;
}

}  // namespace equipoise::study
