// Every purpose draws from counters of its own.
#pragma once

#include <cstdint>

namespace equipoise {

/// Third word of the counter, under the key (seed, 0). Numbers of one purpose do not change when others are drawn too.
enum class StartNumbers : std::uint64_t { angles = 0, others = 1, scrambling = 2, cell_order = 3, parameters = 4 };

}  // namespace equipoise
