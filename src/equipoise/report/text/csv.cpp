// Numbers, texts and studies in CSV.
#include "equipoise/report/text/csv.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "equipoise/core/base/read_number.hpp"

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

}  // namespace equipoise
