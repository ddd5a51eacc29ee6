// What lanes ask of regions that no trajectory leaves again and that are no level set of a table.
#pragma once

#include <memory>

namespace equipoise {

struct OwnRotor;

struct Caught {
  int attractor = 0;  ///< its identifier, 0 if there is none
  double wait = 0.0;  ///< if so, how long it is not worth asking again
};

/// Says of one state at a time which attractor has caught it.
class TrapSet {
 public:
  virtual ~TrapSet() = default;
  /// `psi`: the rotor's angle; `own`: the trajectory's own rotor, null if it has none. Thread-safe.
  virtual Caught ask(const double* state, double psi, const OwnRotor* own) const = 0;
};
using Traps = std::shared_ptr<const TrapSet>;

}  // namespace equipoise
