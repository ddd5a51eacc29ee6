// The interface by which lanes test trapping regions that no table of level sets describes. Implemented in the room
// trapping_regions and in classification/attractor_search/coasting.cpp.
#pragma once

#include <memory>

namespace equipoise {

struct OwnRotor;

struct Caught {
  int attractor = 0;  ///< its identifier; 0: not caught
  double wait = 0.0;  ///< if not caught: how long another test would be useless
};

/// Says which attractor has caught a state.
class TrappingRegions {
 public:
  virtual ~TrappingRegions() = default;
  /// `psi`: the rotor's angle; `own`: the trajectory's own rotor, null if it has none. Thread-safe.
  virtual Caught ask(const double* state, double psi, const OwnRotor* own) const = 0;
};
using SharedRegions = std::shared_ptr<const TrappingRegions>;

}  // namespace equipoise
