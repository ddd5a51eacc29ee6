// Where gravity holds a rotor against its motor: which of the places it comes to rest in.
#pragma once

#include <vector>

#include "equipoise/mechanics/gravity_well.hpp"
#include "equipoise/model/system.hpp"

namespace equipoise {

/// All energy goes, so that only a place to rest is left: one, but for each order of unlike balls that touch.
struct StalledRegion {
  struct Rest {
    std::vector<int> order;  ///< kinds of balls side by side; empty: whatever it is
    int attractor = 0;
  };

  model::GravityWell well;
  std::vector<Rest> rests{};

  /// The rest that `state` will come to, 0 if that is not known yet.
  int caught(const model::System& system, const double* state) const;
};

/// Kinds of the balls at `state` as they stand along the race, from one top to the other, each by the first ball of it;
/// empty if order is nothing.
std::vector<int> order_of(const model::System& system, const double* state);

/// For each order a state near rest; one of more orders than can be looked at.
std::vector<Eigen::VectorXd> places_to_hang(const model::System& system, const model::GravityWell& well);

}  // namespace equipoise
