// Exchange of alike balls: which motions it leaves alone, and which it makes from others.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise {

/// Ball i does what ball order[i] did.
using BallOrder = std::array<int, model::max_balls>;
/// Where the components of a state come from when balls are exchanged: exchanged = state(components). `size`: of the
/// state; 0: a plain state (machine/model/parameters.hpp).
Eigen::VectorXi exchanged_components(int balls, const BallOrder& order, Eigen::Index size = 0);

/// The distance of two states, with alike balls in the order that makes it least.
double distance_in_any_order(const model::System& system, const StateDifference& difference, const Eigen::VectorXd& a,
                             const Eigen::VectorXd& b);

/// For a periodic motion or an equilibrium: one order for each of its Motion::copies under exchange of alike balls, its
/// own first.
std::vector<BallOrder> exchange_images(const model::System& system, const Motion& motion);

/// Motion::copies of a motion whose other members are set.
std::int64_t count_copies(const model::System& system, const Motion& motion);

/// Whether an equilibrium is balanced: the race's centre rests on the axis of rotation.
bool is_balanced(const model::System& system, const Motion& motion);

bool is_half_period_exchange(const model::System& system, const PeriodicOrbit& orbit);

// Pairs of places and things: the cheapest ones, and how many there are.

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
