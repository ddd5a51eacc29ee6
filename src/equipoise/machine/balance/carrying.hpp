// Whether their drag carries balls round against their weight, if gravity acts across the shaft.
// docs/explanation/rules-of-thumb.md, "Carried round".
#pragma once

#include <optional>

#include "equipoise/machine/model/system.hpp"

namespace equipoise::model {

/// A ball that hangs below the shaft feels the drag D psi' of the race, which turns past it. It stays there as long as
/// that is at most m g R. Touching balls push each other: a row of them stays as long as the sum of their drags is at
/// most what it takes to lift their centre of mass, and its ends hang lower than a single ball would.
struct Carrying {
  /// Speeds from which the first of the balls, and from which all, are carried round; infinite without drag.
  double first = 0.0, all = 0.0;
  double reached = 0.0;  ///< speed of the rotor in the end, while the balls that its drive cannot carry brake it
  bool turning = false;  ///< balls are released so fast that none falls
  bool may_hang() const { return reached < all && !turning; }
};

/// Empty without balls or gravity, and if the rotor comes to rest or coasts.
std::optional<Carrying> carrying(const Parameters& p, const Drive& drive);

}  // namespace equipoise::model
