// Where gravity holds a rotor against its motor: the places in which it can come to rest.
#pragma once

#include <vector>

#include "equipoise/machine/mechanics/gravity_well.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// All energy is lost, so the rotor comes to rest: in one place, or in one for each order of unlike touching balls.
struct StalledRegion {
  struct Rest {
    std::vector<int> order;  ///< kinds of balls side by side; empty: any order
    int attractor = 0;
  };

  model::GravityWell well;
  std::vector<Rest> rests{};

  /// The rest that `state` will come to; 0 if not known yet.
  int caught(const model::System& system, const double* state) const;
};

/// Kinds of the balls at `state` in order along the race, from one top to the other, each named by its first ball;
/// empty if order does not matter.
std::vector<int> order_of(const model::System& system, const double* state);

/// A state near rest for each order; only one if there are too many orders.
std::vector<Eigen::VectorXd> places_to_hang(const model::System& system, const model::GravityWell& well);

}  // namespace equipoise
