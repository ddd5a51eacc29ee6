// Cells of a sweep as bytes: what files keep and what processes send each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise::store {

/// CBOR (RFC 8949); every number reads back to the same bits.
std::vector<std::uint8_t> bytes_of(const SweepCell& cell);
/// None if the bytes are no cell.
std::optional<SweepCell> cell_from(const std::uint8_t* bytes, std::size_t count);

}  // namespace equipoise::store
