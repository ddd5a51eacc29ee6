// The Hungarian method with potentials: rows join one after the other, each by the shortest way that lets the earlier
// ones take other columns.
#include "equipoise/core/math/assignment.hpp"

#include <limits>

namespace equipoise {

std::vector<int> cheapest_pairs(const Eigen::MatrixXd& cost) {
  const int n = static_cast<int>(cost.rows()), none = n;
  // Column n stands for the row that is about to join.
  std::vector<double> of_row(static_cast<std::size_t>(n)), of_column(static_cast<std::size_t>(n) + 1);
  std::vector<int> row_of(static_cast<std::size_t>(n) + 1, none), before(row_of.size());
  for (int row = 0; row < n; ++row) {
    std::vector<double> least(row_of.size(), std::numeric_limits<double>::infinity());
    std::vector<char> reached(row_of.size());
    int at = n;
    row_of[at] = row;
    while (row_of[at] != none) {
      reached[at] = true;
      double step = std::numeric_limits<double>::infinity();
      int next = 0;
      for (int k = 0; k < n; ++k) {
        if (reached[k]) continue;
        const double reduced = cost(row_of[at], k) - of_row[row_of[at]] - of_column[k];
        if (reduced < least[k]) {
          least[k] = reduced;
          before[k] = at;
        }
        if (least[k] < step) {
          step = least[k];
          next = k;
        }
      }
      for (int k = 0; k <= n; ++k)
        if (reached[k]) {
          of_row[row_of[k]] += step;
          of_column[k] -= step;
        } else {
          least[k] -= step;
        }
      at = next;
    }
    for (; at != n; at = before[at]) row_of[at] = row_of[before[at]];
  }
  std::vector<int> column_of(static_cast<std::size_t>(n));
  for (int k = 0; k < n; ++k) {
    if (!(cost(row_of[k], k) < no_pair)) return {};
    column_of[row_of[k]] = k;
  }
  return column_of;
}

// ways[set]: for the first rows, as many as there are columns in the set.
std::int64_t count_pairings(const Eigen::MatrixXi& allowed) {
  const int n = static_cast<int>(allowed.rows());
  std::vector<std::int64_t> ways(std::size_t{1} << n);
  ways[0] = 1;
  for (std::size_t set = 0; set < ways.size(); ++set) {
    if (ways[set] == 0) continue;
    int row = 0;
    for (std::size_t rest = set; rest != 0; rest &= rest - 1) ++row;
    for (int k = 0; row < n && k < n; ++k)
      if (!(set >> k & 1) && allowed(row, k) != 0) ways[set | std::size_t{1} << k] += ways[set];
  }
  return ways.back();
}

}  // namespace equipoise
