// Separate random counters for each purpose of a start's numbers.
#pragma once

#include <cstdint>

namespace equipoise {

/// Third word of the counter, under the key (seed, 0): drawing numbers for one purpose does not change the others.
enum class StartNumbers : std::uint64_t { angles = 0, others = 1, scrambling = 2, cell_order = 3, parameters = 4 };

}  // namespace equipoise
