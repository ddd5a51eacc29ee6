// Trees, numbers and texts of settings.
#include "equipoise/analyses/design/settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/toml/toml_tree.hpp"
#include "equipoise/study/units/unit_table.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

StudyValue& table_in(StudyValue& tree, const std::string& dotted) {
  StudyValue* table = &tree;
  for (std::size_t begin = 0; begin < dotted.size();) {
    const std::size_t dot = std::min(dotted.find('.', begin), dotted.size());
    const std::string part = dotted.substr(begin, dot - begin);
    StudyValue* inner = table->find(part);
    table = inner && inner->table() ? inner : &table->set(part, StudyValue());
    begin = dot + 1;
  }
  return *table;
}

}  // namespace

double number_of(const StudyValue& value) {
  return value.string() ? study::split_quantity(*value.string()).number : value.number();
}

std::string unit_of_value(const StudyValue& value) {
  return value.string() ? study::split_quantity(*value.string()).unit : "";
}

double number_in_unit(const StudyValue& value, const std::string& unit) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const std::string written = unit_of_value(value);
  if (!value.is_number() && written.empty()) return none;
  if (written == unit) return number_of(value);
  if (written.empty() || unit.empty()) return none;
  const auto from = study::table_unit(written), to = study::table_unit(unit);
  return from && to ? number_of(value) * from->worth_in(*to) : none;
}

StudyValue value_of(double number, const std::string& unit, bool whole) {
  if (whole) return static_cast<std::int64_t>(std::llround(number));
  const std::string digits = fmt::format("{:.6g}", number);
  if (!unit.empty()) return digits + " " + unit;
  return number_in(digits);
}

std::size_t nearest_allowed(const std::vector<double>& allowed, double number) {
  const auto above = std::lower_bound(allowed.begin(), allowed.end(), number);
  if (above == allowed.begin()) return 0;
  const auto k = static_cast<std::size_t>(above - allowed.begin());
  return above == allowed.end() || number - allowed[k - 1] <= *above - number ? k - 1 : k;
}

double allowed_number(const DesignVariable& variable, const StudyValue& value) {
  for (std::size_t k = 0; k < variable.numbers.size(); ++k)
    if (text_of(variable.choices[k]) == text_of(value)) return variable.numbers[k];
  return number_of(value);
}

std::string text_of(const StudyValue& value) {
  if (!value.table()) return study::value_text(value);
  std::string text;
  for (const auto& [key, entry] : *value.table())
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, text_of(entry));
  return text;
}

std::string text_of(const std::vector<DesignSetting>& settings) {
  std::string text;
  for (const DesignSetting& s : settings)
    text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", s.key, text_of(s.value));
  return text;
}

const StudyValue* stated_in(const StudyValue& tree, const std::string& key) {
  const StudyValue* value = tree.find_path(study::key_here(tree, key));
  return value && !value->table() && !value->array() ? value : nullptr;
}

void set_in(StudyValue& tree, const std::vector<DesignSetting>& settings) {
  for (const DesignSetting& s : settings) {
    if (s.value.table()) {
      tree.set(s.key, s.value);
      continue;
    }
    const std::string key = study::key_here(tree, s.key);
    const std::size_t dot = key.rfind('.');
    StudyValue& table = table_in(tree, key.substr(0, dot));
    table.set(key.substr(dot + 1), s.value);
    if (key == "release.time") table.erase("speed");
    if (key == "release.speed") table.erase("time");
  }
}

}  // namespace equipoise
