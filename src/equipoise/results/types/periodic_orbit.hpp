// A periodic orbit as it is found, with its linear stability.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise {

/// Whole turns of each angle of a system in one period, with sign, in the order of model::System::angles().
using Winding = std::array<int, model::max_balls + 1>;

/// A motion that repeats itself after `period`, angles taken modulo their turns.
struct PeriodicOrbit {
  double period = 0.0;
  Winding winding{};
  /// States at the times k period / nodes.size(), k = 0, 1, ...; angles unwrapped along the orbit. With a
  /// stroboscopic section: the states at its successive instants.
  std::vector<Eigen::VectorXd> nodes;
  /// Floquet multipliers: eigenvalues of the monodromy matrix. Errors are about 1e-12 of the largest. Where the period
  /// is free, the first is the one that belongs to a shift in time (1 but for errors); the others follow with falling
  /// modulus.
  Eigen::VectorXcd multipliers;
  double residual = 0.0;  ///< largest mismatch of any component where one node's arc meets the next node
  /// The period is a whole number of section periods: every multiplier counts, and an equilibrium is an orbit like any
  /// other.
  bool imposed = false;

  /// All multipliers but that of a shift in time.
  Eigen::VectorXcd decays() const { return multipliers.tail(multipliers.size() - (imposed ? 0 : 1)); }
  /// All of them lie inside the unit circle.
  bool stable() const;
  /// At which the deviation that shrinks slowest does so, negative if it shrinks.
  double slowest_rate() const;
};

/// Whether at most `units_allowed` multipliers lie on the unit circle, at 1, and all others inside.
bool contracts(const Eigen::VectorXcd& multipliers, int units_allowed = 0);

}  // namespace equipoise
