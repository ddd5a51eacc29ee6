// Numbers, texts and studies in CSV; columns of parameters.
#include "equipoise/report/text/csv.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"
#include "equipoise/report/text/quantities.hpp"

namespace equipoise {

namespace {

// For a spreadsheet: all that begins so, except for a plain number.
bool is_formula(const std::string& text) {
  return text.find_first_of("=+-@\t\r\n") == 0 && !number_of_all(text.substr(text.front() == '+' ? 1 : 0));
}

}  // namespace

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_text(const std::string& given) {
  std::string text = is_formula(given) ? "'" + given : given;
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string(2, c) : std::string(1, c);
  return quoted + "\"";
}

std::string csv_study(const Study& study) {
  std::string text;
  std::istringstream lines(to_toml(study));
  for (std::string line; std::getline(lines, line);) text += line.empty() ? "#\n" : "# " + line + "\n";
  return text;
}

std::string column_title(const std::string& key, const std::string& unit) {
  return unit.empty() ? key_words(key) : fmt::format("{}, {}", key_words(key), unit);
}

std::vector<std::string> parameter_titles(const std::vector<SweepAxis>& axes) {
  std::vector<std::string> titles;
  visit_parameters(axes, 0,
                   [&](const SweepParameter& p, std::size_t) { titles.push_back(column_title(p.key, p.unit)); });
  return titles;
}

std::vector<DocumentCell> parameter_values(const std::vector<SweepAxis>& axes, std::size_t cell) {
  std::vector<DocumentCell> cells;
  visit_parameters(axes, cell, [&](const SweepParameter& p, std::size_t k) {
    cells.push_back(number_cell(fmt::format("{:.6g}", p.values[k])));
  });
  return cells;
}

std::string csv_title(const std::string& key, const std::string& unit) {
  return csv_text(unit.empty() ? key : fmt::format("{} ({})", key, unit));
}

std::string csv_titles(const std::vector<SweepAxis>& axes) {
  std::string line;
  visit_parameters(axes, 0, [&](const SweepParameter& p, std::size_t) { line += csv_title(p.key, p.unit) + ","; });
  return line;
}

std::string csv_values(const std::vector<SweepAxis>& axes, std::size_t cell) {
  std::string line;
  visit_parameters(axes, cell,
                   [&](const SweepParameter& p, std::size_t k) { line += fmt::format("{},", p.values[k]); });
  return line;
}

std::vector<SweepParameter> parameters_of(const std::vector<SweepAxis>& axes) {
  std::vector<SweepParameter> all;
  visit_parameters(axes, 0, [&](const SweepParameter& p, std::size_t) { all.push_back(p); });
  return all;
}

void to_json(Json& json, const SweepParameter& p) { json = object("key", p.key, "unit", p.unit, "values", p.values); }

void to_json(Json& json, const PartOf<std::size_t, std::vector<SweepAxis>>& cell) {
  json = Json::object();
  visit_parameters(cell.whole, cell.part, [&](const SweepParameter& p, std::size_t k) { json[p.key] = p.values[k]; });
}

}  // namespace equipoise
