// Connected regions of a chart's grid in which the same states exist and are stable.
#pragma once

#include <vector>

#include "equipoise/extras/planes/bifurcation_chart.hpp"

namespace equipoise {

/// What exists at a point.
struct RegionPattern {
  BalanceKind balance = BalanceKind::not_computed;
  std::vector<std::vector<int>> unstable;  ///< by kind of locked state, of each such state: unstable eigenvalues

  bool operator<(const RegionPattern& other) const {
    return balance != other.balance ? balance < other.balance : unstable < other.unstable;
  }
};
/// `pattern_of`: by point of the grid. Sets chart.regions, the largest first, and chart.region_of.
void add_regions(const std::vector<RegionPattern>& patterns, const std::vector<int>& pattern_of,
                 BifurcationChart& chart);

}  // namespace equipoise
