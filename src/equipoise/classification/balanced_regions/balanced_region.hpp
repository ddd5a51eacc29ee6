// Trapping regions around isolated balanced states: how far a Lyapunov function reaches.
// This room: level sets around balance, validated by trajectories.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <vector>

#include <Eigen/Core>

#include "equipoise/core/base/random.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

/// Random directions, the same for every study, by number or one after the other. Each is made once for all searches
/// that share them.
class Directions {
 public:
  explicit Directions(Eigen::Index size) : size_(size) {}
  Eigen::VectorXd operator[](std::size_t number) { return unscaled(number).normalized(); }
  Eigen::VectorXd next() { return (*this)[next_++]; }
  /// Components are standard normal deviates.
  const Eigen::VectorXd& unscaled(std::size_t number);

 private:
  const Eigen::Index size_;
  RandomStream random_;
  std::deque<Eigen::VectorXd> made_;
  std::size_t next_ = 0;
};

/// Smallest V = d^T P d > 0 with dV/dt >= 0 found around the balanced state `centre` of a smooth system with section
/// `none`. It samples `rays` directions (a fixed pseudo-random sequence), takes random steps from the worst, and
/// descends by gradients from the principal directions of dV/dt. The true one is below or equal; 0 if P is not positive
/// definite or V grows at once. Not `descending`: by rays and random steps alone, each ray tested in two places: for
/// comparing forms. For narrow level sets that is several times too high.
double critical_level(const model::System& system, const Eigen::VectorXd& centre, const Eigen::MatrixXd& form, int rays,
                      Directions& vectors, bool descending = true);

/// The trapping region of the linearly stable balanced state at ball angles `phi`, for a smooth system with section
/// `none`. Its level is level_margin times the smallest V at which dV/dt >= 0 was found, by sampling rays and
/// descending from the worst. `weights`: of its modes; on entry those of a neighbouring parameter, or empty.
BalancedRegion balanced_region(const model::System& system, const std::array<double, model::max_balls>& phi,
                               std::vector<ModeWeight>& weights);

/// The trapping region of the other balanced state of two alike balls.
BalancedRegion exchanged(const BalancedRegion& region);

/// The modal form of a linearisation; each mode takes the weight of the nearest one in `weights`.
Eigen::MatrixXd weighted_form(const Eigen::MatrixXd& a, const std::vector<ModeWeight>& weights);

/// P = F^T F of the region's Lyapunov function V = |F d|^2 = d^T P d.
using FactorView = Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
Eigen::MatrixXd form_of(const BalancedRegion& region);

/// Sets the level, and the reach with it.
void set_level(BalancedRegion& region, double level);

/// The level of a trapping region at which two balls could touch. On d^T P d = c the angle between two balls deviates
/// by at most sqrt(c l^T P^-1 l), with l the difference of their angles. Infinite if balls pass each other; 0 if they
/// would overlap in balance.
double touching_level(const model::System& system, const BalancedRegion& region);

/// A state on the level `level`. `direction`: a unit vector of the state's size.
Eigen::VectorXd state_on_level(const BalancedRegion& region, double level, const Eigen::VectorXd& direction);
Eigen::VectorXd state_on_level(const double* place, const double* factor, double level,
                               const Eigen::VectorXd& direction);

/// The share used of the sampled critical level. Two independent searches agree to 1e-4, and decision times depend on
/// the level only through its logarithm, so a wide margin is cheap.
inline constexpr double level_margin = 0.9;

}  // namespace equipoise
