// Reads the printed tables, the conclusions and the fitted readings from their CSV files.
#include "equipoise/extras/literature/published_tables.hpp"

#include <cmath>
#include <cstdlib>
#include <map>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/extras/literature/paper_files.hpp"

namespace equipoise {

const char* const published_citation =
    "J. A. Wright and L. Peng, An automatic dynamic balancer in a rotating mechanism with time-varying angular "
    "velocity, Results in Applied Mathematics (2019), arXiv:1906.04823";

namespace {

using Line = std::map<std::string, std::string>;

std::string text_of(const std::string& name) {
  const std::string_view text = embedded::paper_files.find(name);
  if (text.empty()) throw RunError(fmt::format("{}: the library was built without it", name));
  return std::string(text);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

// Lines of a CSV file whose first line names the columns.
std::vector<Line> lines_of(const std::string& name) {
  std::istringstream file(text_of(name));
  std::vector<std::string> names;
  std::vector<Line> lines;
  for (std::string text; std::getline(file, text);) {
    if (text.empty() || text.front() == '#') continue;
    const std::vector<std::string> values = cells_of(text);
    if (names.empty()) {
      names = values;
      continue;
    }
    Line& line = lines.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) line[names[i]] = values.at(i);
  }
  return lines;
}

std::vector<Line> lines_of(int table) { return lines_of(fmt::format("published/table-{}.csv", table)); }

double value_of(const std::string& text) { return number_in(text); }

// A decimal without exponent or trailing zeros: 1e-06 -> 0.000001, 100.0 -> 100.
std::string plain(const std::string& number) {
  std::string text = fmt::format("{:.9f}", value_of(number));
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// A printed number: a percentage with two decimals, unless it is too small for those. One start of 300 000 is 3.3e-4 %,
// so a number printed below 1e-4 can only be a fraction of one.
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

// Printed shares of all attractors must add up to 100 within their rounding.
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

// A row that is one ensemble, with one cell per attractor.
PublishedRow published_row(const std::string& study, const std::string& label, double parameter, const Line& line,
                           std::uint64_t starts) {
  PublishedRow row{study, label, "", parameter, {}, ""};
  for (const char* attractor : {"balanced", "V1", "V2", "V3", "V4"})
    if (const auto at = line.find(attractor); at != line.end())
      row.cells.push_back(cell(attractor, at->second, starts));
  row.slip = slip_of(row.cells);
  return row;
}

// A row's parameter as in the name of its study.
std::pair<const char*, std::string> named(const std::string& column, const Line& line) {
  if (column == "T0") return {"t0", plain(line.at(column))};
  return {"omega", line.at(column)};
}

PublishedTable table_of_rows(int number, const std::string& title, const std::string& column, bool ramps,
                             std::uint64_t starts) {
  PublishedTable table{number, title, column, ramps, "", {}};
  for (const Line& line : lines_of(number)) {
    const auto [key, value] = named(column, line);
    table.rows.push_back(published_row(fmt::format("table-{}-{}-{}", number, key, value),
                                       fmt::format("{} = {}", column, value), value_of(value), line, starts));
  }
  return table;
}

// Every cell is its own ensemble; each of `values` completes `study`, `series` and `column`.
PublishedTable table_of_columns(PublishedTable table, const std::vector<const char*>& values, const char* study,
                                const std::string& series, const std::string& column) {
  for (const char* value : values)
    for (const Line& line : lines_of(table.number)) {
      const auto [key, parameter] = named(table.parameter, line);
      table.rows.push_back({fmt::format("table-{}-{}-{}-{}-{}", table.number, study, value, key, parameter),
                            fmt::format("{} = {}, {}{}", table.parameter, parameter, series, value),
                            series + value,
                            value_of(parameter),
                            {cell("balanced", line.at(column + value), 300000)},
                            ""});
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
    table.rows.push_back(published_row(fmt::format("table-7-t0-{}-t1-{}-t2-{}", t0, t1, t2),
                                       fmt::format("{}, {}, {}", t0, t1, t2), value_of(t0), line, 300000));
  }
  return table;
}

}  // namespace

const std::vector<PublishedTable>& published_tables() {
  static const std::vector<PublishedTable> tables = {
      table_of_columns({1, "constant speed, four values of the balls' drag", "Omega", false, "", {}},
                       {"0.01", "0.05", "0.1", "0.25"}, "beta", "beta = ", "balanced_beta_"),
      table_of_rows(2, "constant speed", "Omega", false, 300000),
      table_of_rows(3, "ramp 0 to 2.4 in T0, balls released at 2.4", "T0", true, 100000),
      table_of_rows(4, "ramp 0 to Omega_f in T0 = 500, balls released at Omega_f", "Omega_f", true, 100000),
      table_of_rows(5, "ramp 0 to 2.4 in T0, balls released at 2.2", "T0", true, 100000),
      table_of_columns({6, "ramp 0 to 5 in T0, balls released at 2 or at 3", "T0", true, "", {}}, {"2", "3"}, "release",
                       "release at ", "balanced_Omega_r_"),
      table_7()};
  return tables;
}

std::vector<Table7Reading> table_7_readings() {
  std::vector<Table7Reading> list;
  for (const Line& line : lines_of("evidence/table-7-candidates.csv")) {
    const auto number = [&](const std::string& column) { return value_of(line.at(column)); };
    const std::string &origin = line.at("test_origin"), &offset = line.at("test_offset"), &span = line.at("span");
    const std::string when = origin == "t" ? "t = " + offset : origin + " " + offset;
    list.push_back({line.at("protocol"),
                    fmt::format("r < {:.3g} ", number("tolerance")) +
                        (number("span") > 0.0 ? fmt::format("for {} up to {}", span, when) : "at " + when),
                    fmt::format("{:.2f}, {:.2f}, {:.2f}, {:.2f}", number("share_1"), number("share_2"),
                                number("share_3"), number("share_4")),
                    plain(line.at("starts")), fmt::format("{:.1f}", number("chi2")), plain(line.at("free_cells"))});
  }
  return list;
}

const std::vector<Conclusion>& conclusions() {
  static const std::vector<Conclusion> all = [] {
    std::vector<Conclusion> list;
    for (const Line& line : lines_of("conclusions.csv")) {
      const auto kind = line.at("kind") == "rises" ? Conclusion::Kind::rises : Conclusion::Kind::unchanged;
      if (list.empty() || list.back().text != line.at("conclusion"))
        list.push_back({line.at("conclusion"), static_cast<int>(value_of(line.at("table"))), kind, {}});
      list.back().contrasts.push_back({line.at("first"), line.at("second")});
    }
    return list;
  }();
  return all;
}

Study study_of(const PublishedRow& row, model::SpeedLaw law) {
  const std::string name = row.study + ".toml";
  Study study = parse_study(text_of("studies/" + name), "studies/paper/" + name);
  if (study.speed.profile != Profile::constant) study.speed.law = law;
  return study;
}

}  // namespace equipoise
