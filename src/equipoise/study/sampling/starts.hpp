// Random starts addressed by (seed, index): each can be repeated alone.
#pragma once

#include <cstdint>
#include <string_view>

namespace equipoise {

/// Writes the ball angles of start `index`: independent, uniform on [0, 2 pi).
void start_angles(std::uint64_t seed, std::uint64_t index, int balls, double* phi);

/// Writes `count` further numbers of start `index`, uniform on [0, 1), independent of its angles and of each other.
void start_fractions(std::uint64_t seed, std::uint64_t index, int count, double* fractions);

/// A number of start `index` for `name`, uniform on [0, 1), independent of everything else drawn.
double start_fraction(std::uint64_t seed, std::uint64_t index, std::string_view name);

/// Third word of the counter, under the key (seed, 0): drawing numbers for one purpose does not change the others.
enum class StartNumbers : std::uint64_t { angles = 0, others = 1, scrambling = 2, cell_order = 3, parameters = 4 };

}  // namespace equipoise
