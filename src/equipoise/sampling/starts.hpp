// Random starts addressed by (seed, index): any one is replayable alone.
#pragma once

#include <cstdint>
#include <string_view>

namespace equipoise {

/// Writes the ball angles of start `index`: independent, uniform on [0, 2 pi).
void start_angles(std::uint64_t seed, std::uint64_t index, int balls, double* phi);

/// Writes `count` further numbers of start `index`, independent of its angles and of each other, uniform on [0, 1).
void start_fractions(std::uint64_t seed, std::uint64_t index, int count, double* fractions);

/// A number of start `index` for `name`, uniform on [0, 1), independent of what else is drawn.
double start_fraction(std::uint64_t seed, std::uint64_t index, std::string_view name);

}  // namespace equipoise
