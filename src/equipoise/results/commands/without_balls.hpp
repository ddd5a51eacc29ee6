// What an ensemble's rotor does without its balls, and with balls that stay where they start.
#pragma once

#include <cstdint>
#include <vector>

#include "equipoise/results/commands/transient_result.hpp"

namespace equipoise {

/// One body's runs over the same drive, by the figures of the ensemble's transients.
struct OneBodyRuns {
  TransientGroup figures;     ///< of all runs that were not lost; what the drive's work would be is not told
  bool one = false;           ///< every start has the same: a single run, whose intervals say nothing
  std::uint64_t runs = 0;     ///< followed
  std::uint64_t stalled = 0;  ///< of driven rotors: that their motor does not bring up to speed
  std::uint64_t open = 0;     ///< without a steady motion while followed; their figures at the end are the last seen
  std::uint64_t lost = 0;     ///< that diverged or failed
  std::vector<PairedStart> first{};  ///< runs that have the rotors of the ensemble's first starts
};

/// Displacements of each count from its own place of rest. Depends on the study and on how many starts there are.
struct WithoutBalls {
  OneBodyRuns bare;  ///< no balls
  OneBodyRuns held;  ///< balls held where they start: the first starts
};
/// Starts whose balls are held.
inline constexpr std::uint64_t most_held_starts = most_paired_starts;

}  // namespace equipoise
