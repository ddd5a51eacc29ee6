// Trees, numbers and texts of settings.
#include "equipoise/analyses/design/settings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/study/toml/toml_tree.hpp"
#include "equipoise/study/units/unit_table.hpp"

namespace equipoise {

namespace {

// The text after the number.
std::string_view behind_number(const std::string& text, double& number) {
  const auto read = read_number(text.data(), text.data() + text.size(), number);
  std::string_view rest(read.end, text.data() + text.size() - read.end);
  rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
  return read.error == std::errc() ? rest : std::string_view();
}

// speed.final names the final speed whatever the profile.
std::string key_in(const StudyValue& tree, const std::string& key) {
  const StudyValue* profile = key == "speed.final" ? tree.find_path("speed.profile") : nullptr;
  return profile && profile->string() && *profile->string() == "constant" ? "speed.speed" : key;
}

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
  double number = value.number();
  if (const std::string* text = value.string()) behind_number(*text, number);
  return number;
}

std::string unit_of_value(const StudyValue& value) {
  double number = 0.0;
  return value.string() ? std::string(behind_number(*value.string(), number)) : "";
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
  StudyValue table{{"v", value}};
  if (value.table()) {
    std::string text;
    for (const auto& [key, entry] : *value.table())
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, text_of(entry));
    return text;
  }
  const std::string text = study::toml_text(StudyValue{{"t", table}});  // "[t]\nv = ...\n"
  const std::size_t begin = text.find("v = ") + 4;
  return text.substr(begin, text.size() - begin - 1);
}

std::string text_of(const std::vector<DesignSetting>& settings) {
  std::string text;
  for (const DesignSetting& s : settings)
    text += fmt::format("{}{} = {}", text.empty() ? "" : "; ", s.key, text_of(s.value));
  return text;
}

const StudyValue* stated_in(const StudyValue& tree, const std::string& key) {
  const StudyValue* value = tree.find_path(key_in(tree, key));
  return value && !value->table() && !value->array() ? value : nullptr;
}

void set_in(StudyValue& tree, const std::vector<DesignSetting>& settings) {
  for (const DesignSetting& s : settings) {
    if (s.value.table()) {
      tree.set(s.key, s.value);
      continue;
    }
    const std::string key = key_in(tree, s.key);
    const std::size_t dot = key.rfind('.');
    StudyValue& table = table_in(tree, key.substr(0, dot));
    table.set(key.substr(dot + 1), s.value);
    if (key == "release.time") table.erase("speed");
    if (key == "release.speed") table.erase("time");
  }
}

}  // namespace equipoise
