// Cells of a sweep, and trials of a capacity, as bytes: what files keep and what processes send each other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "equipoise/results/capacity_result.hpp"
#include "equipoise/results/sweep_result.hpp"

namespace equipoise::store {

/// CBOR (RFC 8949); every number reads back to the same bits.
std::vector<std::uint8_t> bytes_of(const SweepCell& cell);
/// None if the bytes are no cell.
std::optional<SweepCell> cell_from(const std::uint8_t* bytes, std::size_t count);

/// The same of a cell's trials, some or all.
std::vector<std::uint8_t> bytes_of(const std::vector<CapacityTrial>& trials);
std::optional<std::vector<CapacityTrial>> trials_from(const std::vector<std::uint8_t>& bytes);

}  // namespace equipoise::store
