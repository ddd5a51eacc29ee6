// Pairs of places and things: the cheapest ones, and how many there are.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace equipoise {

/// What a pair that must not be costs. Others cost 0 to far less.
inline constexpr double no_pair = 1e100;

/// Which column each row takes, one each, so that the sum of cost(row, column) is least (the Hungarian method, H. W.
/// Kuhn, Naval Research Logistics Quarterly 2 (1955) 83). As many rows as columns. Empty if some row is left with
/// no_pair.
std::vector<int> cheapest_pairs(const Eigen::MatrixXd& cost);

/// Number of ways to give each row a column of its own where allowed(row, column) is not 0: the permanent. At most 20
/// rows, and as many columns.
std::int64_t count_pairings(const Eigen::MatrixXi& allowed);

}  // namespace equipoise
