// Words and numbers that every form of a reproduction shares.
#include "equipoise/reproduction/reproduction_words.hpp"

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/deciding/decision_rule.hpp"

namespace equipoise {

std::string percentage(const Share& s) {
  const double value = 100.0 * s.share;
  const int digits = s.count == 0 || value >= 0.1 ? 2 : value >= 0.01 ? 3 : value >= 0.001 ? 4 : 5;
  return fmt::format("{:.{}f}", value, digits);
}

std::string printed_percentage(const PublishedCell& cell) {
  const double value = 100.0 * cell.share.share;
  if (!cell.fraction) return value > 0.0 && value < 0.01 ? fmt::format("{:.3f}", value) : fmt::format("{:.2f}", value);
  return fmt::format("{:.2g}*", value);
}

std::string p_value_text(double p) {
  return p < 1e-12 ? "< 1e-12" : p < 1e-4 ? fmt::format("{:.0e}", p) : fmt::format("{:.4f}", p);
}

std::string verdict_text(const ReproducedCell& cell) {
  if (cell.reason.empty()) return name_of(cell.verdict);
  return fmt::format("{}: {}", name_of(cell.verdict), cell.reason);
}

std::string difference_text(const ShareDifference& d) {
  return fmt::format("{:+.2f} ({:+.2f} to {:+.2f})", 100.0 * d.difference, 100.0 * d.low, 100.0 * d.high);
}

std::string answer_text(const ConclusionResult& c) {
  if (c.differences.empty()) return name_of(c.answer);
  const auto [least, most] =
      std::minmax_element(c.differences.begin(), c.differences.end(),
                          [](const auto& a, const auto& b) { return a.difference < b.difference; });
  if (c.differences.size() == 1) return fmt::format("{}: {}", name_of(c.answer), difference_text(*least));
  return fmt::format("{}: from {} to {}", name_of(c.answer), difference_text(*least), difference_text(*most));
}

std::string summary_text(const Reproduction& r) {
  std::string text = fmt::format("{:<10}{:>8}{:>9}{:>16}\n", "", "agree", "differ", "not comparable");
  int agree = 0, differ = 0, rest = 0;
  for (const ReproducedTable& t : r.tables) {
    text +=
        fmt::format("table {:<4}{:>8}{:>9}{:>16}\n", t.published->number, t.agreeing, t.differing, t.not_comparable);
    agree += t.agreeing;
    differ += t.differing;
    rest += t.not_comparable;
  }
  text += fmt::format("{:<10}{:>8}{:>9}{:>16}\n", "all", agree, differ, rest);
  text += "Judged jointly over each table at 99 % by the errors of both samples, under the published law.\n";
  return text;
}

std::string codes_text(const PlaneMap& map) {
  std::vector<MapCode> codes = map.codes;
  std::stable_sort(codes.begin(), codes.end(),
                   [](const MapCode& a, const MapCode& b) { return a.share.count > b.share.count; });
  std::string list;
  for (const MapCode& c : codes)
    if (c.share.count > 0)
      list += fmt::format("{}{}{} {:.1f} %", list.empty() ? "" : ", ", c.name,
                          c.alias.empty() ? "" : " (" + c.alias + ")", 100.0 * c.share.share);
  return list;
}

namespace {

// First and last pixels of stretches for which `holds`.
std::vector<std::pair<int, int>> stretches(int pixels, const std::function<bool(int)>& holds) {
  std::vector<std::pair<int, int>> result;
  for (int k = 0; k < pixels; ++k) {
    if (!holds(k)) continue;
    if (result.empty() || result.back().second != k - 1) result.emplace_back(k, k);
    result.back().second = k;
  }
  return result;
}

std::string at_lambda(const PlaneMap& map, const std::vector<std::pair<int, int>>& stretches) {
  std::string text;
  for (const auto& [first, last] : stretches)
    text += fmt::format("{}{:.3g} to {:.3g}", text.empty() ? "at λ from " : " and from ", map.x.centre(first),
                        map.x.centre(last));
  return text.empty() ? "nowhere" : text;
}

std::string balanced_by_angle(const PlaneMap& map) {
  const auto balanced = [&](int column, int row) { return map.code[map.at(column, row)] == balanced_id; };
  const auto count = [&](int column) {
    int sum = 0;
    for (int row = 0; row < map.y.pixels; ++row) sum += balanced(column, row);
    return sum;
  };
  const auto all = stretches(map.x.pixels, [&](int column) { return count(column) == map.y.pixels; });
  const auto some = stretches(map.x.pixels, [&](int column) { return count(column) > 0; });
  const model::Parameters& p = map.study.parameters;
  return fmt::format("Every start balances {}; some balance {}. The balls can cancel λ up to {:.3g}.",
                     at_lambda(map, all), at_lambda(map, some), p.total_mass());
}

// In the mass that the balls have together.
std::string balanced_by_mass(const PlaneMap& map) {
  double least = 1e300, most = 0.0, of_least = 0.0, of_most = 0.0;
  int rows = 0, again = 0;
  for (int row = 0; row < map.y.pixels; ++row) {
    const auto here =
        stretches(map.x.pixels, [&](int column) { return map.code[map.at(column, row)] == balanced_id; });
    if (here.empty()) continue;
    const double mass = map.y.centre(row), all = map.study.parameters.balls * mass;
    const double reached = map.x.centre(here.front().second) / all;
    ++rows;
    again += here.size() > 1;
    if (reached < least) of_least = mass;
    if (reached > most) of_most = mass;
    least = std::min(least, reached);
    most = std::max(most, reached);
  }
  if (rows == 0) return "Nothing balances.";
  return fmt::format(
      "As λ grows starts first cease to balance at {:.2f} (μ = {:.3g}) to {:.2f} (μ = {:.3g}) of what the balls can "
      "cancel, {} μ; in {} of {} rows that balance some balance again at a larger λ.",
      least, of_least, most, of_most, map.study.parameters.balls, again, rows);
}

}  // namespace

std::string balanced_text(const PlaneMap& map) {
  return map.y.angle() ? balanced_by_angle(map) : balanced_by_mass(map);
}

}  // namespace equipoise
