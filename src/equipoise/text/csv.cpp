// Numbers, texts and studies in CSV.
#include "equipoise/text/csv.hpp"

#include <cmath>
#include <sstream>

#include <fmt/format.h>

namespace equipoise {

std::string csv_number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

std::string csv_text(const std::string& text) {
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
