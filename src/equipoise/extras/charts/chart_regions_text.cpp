// Letters, lists of states, the table.
#include "equipoise/extras/charts/chart_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "equipoise/core/base/plain_number.hpp"
#include "equipoise/extras/charts/plane_plot.hpp"
#include "equipoise/extras/charts/stability_report.hpp"

namespace equipoise {

std::string region_words(const BifurcationChart& chart, const ChartRegion& region) {
  std::string text = fmt::format("balance {}", balance_words(region.balance));
  for (std::size_t k = 0; k < region.locked.size(); ++k)
    for (const auto& [count, kind] :
         {std::pair{region.locked[k].stable, BalanceKind::stable}, {region.locked[k].unstable, BalanceKind::unstable}})
      if (count > 0)
        text += "; " + fmt::format("{} {}{}", chart.locked[k], balance_words(kind),
                                   count > 1 ? fmt::format(" ({})", count) : std::string());
  return text;
}

std::string stable_words(const BifurcationChart& chart, const ChartRegion& region) {
  std::vector<std::string> stable;
  if (region.balance == BalanceKind::stable) stable.push_back(of_balance);
  for (std::size_t k = 0; k < region.locked.size(); ++k)
    if (region.locked[k].stable > 0) stable.push_back(chart.locked[k]);
  return stable.empty() ? "nothing" : fmt::format("{}", fmt::join(stable, ", "));
}

std::size_t told_regions(const BifurcationChart& chart) {
  constexpr std::size_t letters = 26;
  std::size_t count = 0;
  while (count < std::min(letters, chart.regions.size()) && chart.regions[count].part >= 0.005) ++count;
  return count;
}

std::string region_letter(std::size_t number) { return std::string(1, static_cast<char>('A' + number)); }

std::string regions_list(const BifurcationChart& chart, const TextStyle& style) {
  const double x = shown_axis(chart.study, chart.plane.x).factor, y = shown_axis(chart.study, chart.plane.y).factor;
  std::string text;
  for (std::size_t k = 0; k < told_regions(chart); ++k) {
    const ChartRegion& r = chart.regions[k];
    text += filled(
        fmt::format("{} {:5.1f} %  ", region_letter(k), 100.0 * r.part),
        fmt::format("{} (e.g. at {}, {})", region_words(chart, r), plain_number(r.x * x, 3), plain_number(r.y * y, 3)),
        style);
  }
  return text;
}

std::string region_notes(const BifurcationChart& chart) {
  std::string text;
  if (!chart.no_locked.empty()) text += fmt::format("Of other states at rest nothing is told: {}.\n", chart.no_locked);
  if (chart.regions.empty()) return text;
  if (const std::size_t more = chart.regions.size() - told_regions(chart); more > 0)
    text += fmt::format("Smaller regions are left out ({}); --json has them.\n", more);
  return text + "Regions tell of states at rest, as the grid's points have them, not of motions that go on.\n";
}

}  // namespace equipoise
