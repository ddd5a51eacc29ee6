// Members of a continuum of balanced states, drawn evenly.
#pragma once

#include <array>

#include "equipoise/base/random.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise {

/// Ball angles drawn evenly among those that balance to a twentieth of what balls and unbalance could make together,
/// then balanced. Balls that collide have room beside each other; where hardly any angles leave them that, a random
/// walk among those that do takes the place of draws. The same sequence for the same rotor.
class ContinuumDraws {
 public:
  /// `p` outlives this.
  explicit ContinuumDraws(const model::Parameters& p) : p_(p) {}

  /// The next ones. False where hardly any angles balance, so that none were met.
  bool next(std::array<double, model::max_balls>& phi);
  /// Changes `phi` to others not farther away than about `distance`. False if none there balance.
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
