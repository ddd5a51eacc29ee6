// Random starts addressed by (seed, index): any one is replayable alone.
#pragma once

#include <cstdint>

namespace equipoise {

/// Writes the ball angles of start `index`: independent, uniform on [0, 2 pi), by random_words() with the seed as key and
/// the index as counter.
void start_angles(std::uint64_t seed, std::uint64_t index, int balls, double* phi);

/// Writes `count` further numbers of start `index`, independent of its angles and of each other, uniform on [0, 1).
void start_fractions(std::uint64_t seed, std::uint64_t index, int count, double* fractions);

}  // namespace equipoise
