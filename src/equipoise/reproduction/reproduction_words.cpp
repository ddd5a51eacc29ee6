// Words and numbers that every form of a reproduction shares.
#include "equipoise/reproduction/reproduction_words.hpp"

#include <algorithm>

#include <fmt/format.h>

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

}  // namespace equipoise
