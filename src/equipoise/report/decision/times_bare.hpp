// An ensemble's vibration over that of the same rotors without balls.
#pragma once

#include <array>

#include "equipoise/results/commands/basin_result.hpp"

namespace equipoise {

/// Where every start has the same rotor, that rotor's one run is what each start is compared with; else each of the
/// first starts is compared with the run of its own rotor.
struct TimesBare {
  /// Of starts, by their RMS velocity at the end over that without balls; bounds hold however undecided starts end.
  std::array<QuantileEstimate, reported_quantiles.size()> end_velocity{};
  /// The peak that nine starts of ten stay below, over the peak that nine rotors of ten stay below without balls.
  QuantileEstimate peak;
};

/// Of a result that tells_without_balls().
TimesBare times_bare(const BasinResult& result);

}  // namespace equipoise
