// Cells of a sweep, trials of a capacity and ensembles of a design as bytes, for files and messages.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "equipoise/results/commands/capacity_result.hpp"
#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// An ensemble of a design's candidate, under the name of its question.
struct KeptSample {
  std::string name;
  DesignSample sample;
};
using KeptSamples = std::map<std::uint64_t, KeptSample>;  ///< by the number of their question

namespace io {

/// CBOR (RFC 8949): members by name; every number reads back to the same bits.
std::vector<std::uint8_t> bytes_of(const SweepCell& cell);
std::vector<std::uint8_t> bytes_of(const std::vector<CapacityTrial>& trials);  ///< of one cell, some or all
std::vector<std::uint8_t> bytes_of(const KeptSample& sample);

/// Throws RunError with the place in the record if the bytes are no such record: types, lengths and ranges are checked.
SweepCell cell_from(const std::vector<std::uint8_t>& bytes);
std::vector<CapacityTrial> trials_from(const std::vector<std::uint8_t>& bytes);
KeptSample sample_from(const std::vector<std::uint8_t>& bytes);

}  // namespace io
}  // namespace equipoise
