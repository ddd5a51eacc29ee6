// Reads the printed tables, the conclusions and the fitted readings from their CSV files.
#include "equipoise/extras/literature/published_tables.hpp"

#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "equipoise/core/base/embedded.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"

namespace equipoise {

namespace embedded {
/// The printed tables ("published/rows.csv"), the studies of their rows ("studies/table-2-omega-2.4.toml"), the
/// conclusions, the evidence on table 7.
extern const Archive paper_files;
}  // namespace embedded

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

// A decimal without exponent or trailing zeros: 1e-06 -> 0.000001, 100.0 -> 100.
std::string plain(const std::string& number) {
  std::string text = fmt::format("{:.9f}", number_in(number));
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

// A printed number: a percentage with two decimals, unless it is too small for those. One start of 300 000 is 3.3e-4 %,
// so a number printed below 1e-4 can only be a fraction of one.
PublishedCell cell(const std::string& attractor, const std::string& printed, std::uint64_t starts) {
  PublishedCell result{attractor, printed, false, {0.0, 0.0, starts}};
  const double value = number_in(printed);
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

std::vector<PublishedTable> read_tables() {
  std::vector<PublishedTable> tables;
  for (const Line& line : lines_of("published/tables.csv"))
    tables.push_back({static_cast<int>(tables.size()) + 1,
                      line.at("title"),
                      line.at("parameter"),
                      line.at("ramps") == "yes",
                      line.at("unclaimed"),
                      {}});
  for (const Line& line : lines_of("published/rows.csv")) {
    PublishedRow row{line.at("study"), line.at("label"), line.at("series"), number_in(line.at("parameter")), {}, ""};
    const auto starts = static_cast<std::uint64_t>(number_in(line.at("starts")));
    for (const char* attractor : {"balanced", "V1", "V2", "V3", "V4"})
      if (const std::string& printed = line.at(attractor); !printed.empty())
        row.cells.push_back(cell(attractor, printed, starts));
    row.slip = slip_of(row.cells);
    tables.at(static_cast<std::size_t>(number_in(line.at("table"))) - 1).rows.push_back(std::move(row));
  }
  return tables;
}

}  // namespace

const std::vector<PublishedTable>& published_tables() {
  static const std::vector<PublishedTable> tables = read_tables();
  return tables;
}

std::vector<Table7Reading> table_7_readings() {
  std::vector<Table7Reading> list;
  for (const Line& line : lines_of("evidence/table-7-candidates.csv")) {
    const auto number = [&](const std::string& column) { return number_in(line.at(column)); };
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
        list.push_back({line.at("conclusion"), static_cast<int>(number_in(line.at("table"))), kind, {}});
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
