// The printed tables, read from their CSV files.
#include "equipoise/literature/published_tables.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "equipoise/literature/paper_files.hpp"
#include "equipoise/base/error.hpp"

namespace equipoise {

const char* const published_citation =
    "J. A. Wright and L. Peng, An automatic dynamic balancer in a rotating mechanism with time-varying angular "
    "velocity, Results in Applied Mathematics (2019), arXiv:1906.04823";

namespace {

using Line = std::map<std::string, std::string>;

std::string_view required(const std::string& name) {
  const std::string_view text = embedded::paper_files.find(name);
  if (text.empty()) throw RunError(name + ": the library was built without it");
  return text;
}

std::vector<Line> lines_of(int table) {
  std::istringstream file{std::string(required(fmt::format("published/table-{}.csv", table)))};
  std::vector<std::string> names;
  std::vector<Line> lines;
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text.front() == '#') continue;
    std::istringstream cells(text);
    std::vector<std::string> values;
    for (std::string cell; std::getline(cells, cell, ',');) values.push_back(cell);
    if (names.empty()) {
      names = values;
      continue;
    }
    Line line;
    for (std::size_t i = 0; i < names.size(); ++i) line[names[i]] = values.at(i);
    lines.push_back(line);
  }
  return lines;
}

double value_of(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

// A decimal without exponent or idle zeros: 1e-06 -> 0.000001, 100.0 -> 100.
std::string plain(const std::string& number) {
  std::string text = fmt::format("{:.9f}", value_of(number));
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// A printed number: two decimals of a percentage, unless it is smaller than those can show. One start of 300 000 is
// 3.3e-4 %, so what is printed below 1e-4 can only be a fraction of one.
PublishedCell cell(const std::string& attractor, const std::string& printed, std::uint64_t starts) {
  PublishedCell result{attractor, printed, false, {0.0, 0.0, starts}};
  const double value = value_of(printed);
  result.fraction = value > 0.0 && value < 1e-4;
  const double last_digit = value > 0.0 && value < 0.01 ? std::pow(10.0, std::floor(std::log10(value) + 1e-9)) : 0.01;
  const double scale = result.fraction ? 1.0 : 100.0;
  result.share.share = value / scale;
  result.share.rounding = 0.5 * last_digit / scale;
  return result;
}

// Printed shares of all attractors must sum to 100 within their rounding.
std::string slip_of(const std::vector<PublishedCell>& cells) {
  if (cells.size() < 2) return "";
  double sum = 0.0, slack = 1e-9;
  for (const PublishedCell& c : cells) {
    sum += c.share.share;
    slack += c.share.rounding;
  }
  if (std::fabs(sum - 1.0) <= slack) return "";
  return fmt::format("the printed row sums to {:.2f}", 100.0 * sum);
}

PublishedRow row_of(const std::string& study, const std::string& label, double parameter, const Line& line,
                    std::uint64_t starts) {
  PublishedRow row{study, label, "", parameter, {}, ""};
  for (const char* attractor : {"balanced", "V1", "V2", "V3", "V4"})
    if (const auto at = line.find(attractor); at != line.end())
      row.cells.push_back(cell(attractor, at->second, starts));
  row.slip = slip_of(row.cells);
  return row;
}

// A column that is an ensemble of its own.
PublishedRow column_of(const std::string& study, const std::string& label, const std::string& series, double parameter,
                       const std::string& printed, std::uint64_t starts) {
  return {study, label, series, parameter, {cell("balanced", printed, starts)}, ""};
}

PublishedTable table_1() {
  PublishedTable table{1, "constant speed, four values of the balls' drag", "Omega", false, "", {}};
  for (const char* beta : {"0.01", "0.05", "0.1", "0.25"})
    for (const Line& line : lines_of(1)) {
      const std::string omega = line.at("Omega");
      table.rows.push_back(column_of(fmt::format("table-1-beta-{}-omega-{}", beta, omega),
                                     fmt::format("Omega = {}, beta = {}", omega, beta), fmt::format("beta = {}", beta),
                                     value_of(omega), line.at(fmt::format("balanced_beta_{}", beta)), 300000));
    }
  return table;
}

PublishedTable table_by_speed(int number, const std::string& title, const char* column, bool ramps,
                              std::uint64_t starts) {
  PublishedTable table{number, title, column, ramps, "", {}};
  for (const Line& line : lines_of(number)) {
    const std::string omega = line.at(column);
    table.rows.push_back(row_of(fmt::format("table-{}-omega-{}", number, omega), fmt::format("{} = {}", column, omega),
                                value_of(omega), line, starts));
  }
  return table;
}

PublishedTable table_by_duration(int number, const std::string& title) {
  PublishedTable table{number, title, "T0", true, "", {}};
  for (const Line& line : lines_of(number)) {
    const std::string t0 = plain(line.at("T0"));
    table.rows.push_back(
        row_of(fmt::format("table-{}-t0-{}", number, t0), fmt::format("T0 = {}", t0), value_of(t0), line, 100000));
  }
  return table;
}

PublishedTable table_6() {
  PublishedTable table{6, "ramp 0 to 5 in T0, balls released at 2 or at 3", "T0", true, "", {}};
  for (const char* release : {"2", "3"})
    for (const Line& line : lines_of(6)) {
      const std::string t0 = plain(line.at("T0"));
      table.rows.push_back(column_of(fmt::format("table-6-release-{}-t0-{}", release, t0),
                                     fmt::format("T0 = {}, release at {}", t0, release),
                                     fmt::format("release at {}", release), value_of(t0),
                                     line.at(fmt::format("balanced_Omega_r_{}", release)), 300000));
    }
  return table;
}

PublishedTable table_7() {
  PublishedTable table{7,
                       "0 to 3 until T0, 3 until T1, 3 to 2 until T2; balls released at 3",
                       "T0",
                       true,
                       "the printed shares follow from no reading of the paper's text that was tried",
                       {}};
  for (const Line& line : lines_of(7)) {
    const std::string t0 = plain(line.at("T0")), t1 = plain(line.at("T1")), t2 = plain(line.at("T2"));
    table.rows.push_back(row_of(fmt::format("table-7-t0-{}-t1-{}-t2-{}", t0, t1, t2),
                                fmt::format("{}, {}, {}", t0, t1, t2), value_of(t0), line, 300000));
  }
  return table;
}

}  // namespace

const std::vector<PublishedTable>& published_tables() {
  static const std::vector<PublishedTable> tables = {
      table_1(),
      table_by_speed(2, "constant speed", "Omega", false, 300000),
      table_by_duration(3, "ramp 0 to 2.4 in T0, balls released at 2.4"),
      table_by_speed(4, "ramp 0 to Omega_f in T0 = 500, balls released at Omega_f", "Omega_f", true, 100000),
      table_by_duration(5, "ramp 0 to 2.4 in T0, balls released at 2.2"),
      table_6(),
      table_7()};
  return tables;
}

Study study_of(const PublishedRow& row, model::SpeedLaw law) {
  const std::string name = row.study + ".toml";
  Study study = parse_study(std::string(required("studies/" + name)), "studies/paper/" + name);
  if (study.speed.profile != Profile::constant) study.speed.law = law;
  return study;
}

}  // namespace equipoise
