// Members of a continuum of balanced states, drawn evenly.
#pragma once

#include <array>

#include "equipoise/core/base/random.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise {

/// Draws ball angles evenly from those that balance to a twentieth of what balls and unbalance could add up to, and
/// then balances them. Colliding balls must have room side by side; if hardly any angles leave that, a random walk
/// among those that do replaces the draws. For a tilting rotor any angles are balanced, for hardly any nearly are.
/// The sequence is the same for the same rotor.
class ContinuumDraws {
 public:
  /// `p` must outlive this.
  explicit ContinuumDraws(const model::Parameters& p) : p_(p) {}

  /// The next angles. False if hardly any angles balance and none were found.
  bool next(std::array<double, model::max_balls>& phi);
  /// Changes `phi` to other balanced angles, up to about `distance` away. False if there are none.
  bool beside(std::array<double, model::max_balls>& phi, double distance);

 private:
  bool balance(std::array<double, model::max_balls>& phi) const;

  const model::Parameters& p_;
  RandomStream random_;
  bool walking_ = false;
  double stride_ = 0.1;  // of the walk
  std::array<double, model::max_balls> place_{};
};

}  // namespace equipoise
