// Tables and figures for a terminal.
#include "table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include <fmt/format.h>

namespace equipoise::bench {

void Table::print() const {
  std::vector<std::size_t> width;
  for (const auto& row : rows_)
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i == width.size()) width.push_back(0);
      width[i] = std::max(width[i], row[i].size());
    }
  for (const auto& row : rows_) {
    std::string line = "  ";
    for (std::size_t i = 0; i < row.size(); ++i)
      line += i == 0 ? fmt::format("{:<{}}", row[i], width[i]) : fmt::format("  {:>{}}", row[i], width[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  }
  std::fflush(stdout);
}

void print_heading(const std::string& text) { fmt::print("\n{}\n{}\n", text, std::string(text.size(), '-')); }

void print_paragraph(const std::string& text, std::size_t hang) {
  constexpr std::size_t columns = 118;
  std::istringstream words(text);
  std::string line = " ", word;
  while (words >> word) {
    if (line.size() + 1 + word.size() > columns) {
      fmt::print("{}\n", line);
      line.assign(1 + hang, ' ');
    }
    line += " " + word;
  }
  fmt::print("{}\n", line);
}

void say(const std::string& text) { fmt::print(stderr, "equipoise_bench: {}\n", text); }

std::string count(double value) {
  if (!std::isfinite(value)) return "-";
  const std::string digits = fmt::format("{:.0f}", std::fabs(value));
  std::string parted = value < 0.0 ? "-" : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) parted += ' ';
    parted += digits[i];
  }
  return parted;
}

std::string figure(double value) {
  if (!std::isfinite(value)) return "-";
  if (value == 0.0) return "0";
  const double size = std::fabs(value);
  if (size >= 99.95) return count(value);
  if (size >= 9.995) return fmt::format("{:.1f}", value);
  if (size >= 0.9995) return fmt::format("{:.2f}", value);
  if (size >= 1e-3) return fmt::format("{:.{}f}", value, 2 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.1e}", value);
}

std::string range(double least, double most) { return fmt::format("{} .. {}", figure(least), figure(most)); }

}  // namespace equipoise::bench
