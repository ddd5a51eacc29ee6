// Members of a continuum of balanced states, drawn evenly.
#pragma once

#include <array>

#include "equipoise/base/random.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Ball angles drawn evenly among those that balance to a twentieth of what balls and unbalance could make together,
/// then balanced. The same sequence for the same rotor.
class ContinuumDraws {
 public:
  /// `p` outlives this.
  explicit ContinuumDraws(const model::Parameters& p) : p_(p) {}

  /// The next ones. False where hardly any angles balance, so that none were met.
  bool next(std::array<double, model::max_balls>& phi);
  /// Changes `phi` to others not farther away than about `distance`. False if none there balance.
  bool beside(std::array<double, model::max_balls>& phi, double distance);

 private:
  const model::Parameters& p_;
  RandomStream random_;
};

}  // namespace equipoise
