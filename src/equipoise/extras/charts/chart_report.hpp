// Curves on which balance changes: text, JSON, CSV, picture.
// This room: planes as text, tables and pictures.
#pragma once

#include <cstddef>
#include <string>

#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise {

/// How the lines on which a stable balance loses its stability are made up: their length in the plane, whose sides
/// count 1.
struct BalanceLoss {
  double soft = 0.0, abrupt = 0.0;  ///< by a swing that stays small beyond the line, or does not
  double unknown = 0.0;             ///< by a swing of which that is not known
  double real = 0.0;                ///< without a swing
  double length() const { return soft + abrupt + unknown; }
};
BalanceLoss balance_loss(const BifurcationChart& chart);

/// Where balance is stable, how it is lost, what is proved: in sentences.
std::string chart_answer(const BifurcationChart& chart);

/// The answer, then curves and points.
std::string chart_text(const BifurcationChart& chart, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/chart.md lists the keys.
std::string chart_json(const BifurcationChart& chart);

/// One line a point of a curve.
std::string chart_csv(const BifurcationChart& chart);

/// A picture file (SVG): boxes in which something is proved, shaded by what; curves, solid where a stable balance loses
/// its stability softly, dashed where abruptly, thin where it was unstable before; those of locked states in colour;
/// special points; letters of regions. `title` goes before the parameters.
std::string chart_plot(const BifurcationChart& chart, const std::string& title);

/// "balance stable; balls together unstable (2)".
std::string region_words(const BifurcationChart& chart, const ChartRegion& region);

/// Regions that are told of and drawn, the largest first: no part below half a percent, and at most as many as letters.
inline std::size_t told_regions(const BifurcationChart& chart) {
  constexpr std::size_t letters = 26;
  std::size_t count = 0;
  while (count < letters && count < chart.regions.size() && chart.regions[count].part >= 0.005) ++count;
  return count;
}
/// "A" of the largest.
inline std::string region_letter(std::size_t number) { return std::string(1, static_cast<char>('A' + number)); }

}  // namespace equipoise
