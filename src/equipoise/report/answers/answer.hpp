// The answer of an ensemble, a sweep, a capacity or a basin slice, in one sentence.
// This room: an answer in one sentence; designs in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/commands/capacity_result.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// "97.1 to 98.9 %", "less than 1.9 %", "more than 98.1 %": 95 % interval of a share.
std::string share_words(const Share& share);

/// "The rotor ends balanced in 97.1 to 98.9 % of runs (95 % confidence); 5 mm is exceeded on the way in 1.6 to 2.5
/// %." Mentions undecided starts, and bounds that hold whatever they come to; omits limits that the study does not
/// have. With uncertain values it begins: "With unbalance sampled for each run, the rotor ends ...".
std::string answer_sentence(const BasinResult& result);

/// Where the rotor balances most and least often, how often at worst a limit is exceeded, how much stays undecided.
std::string answer_sentence(const SweepResult& result);
/// Of all starts of a cell, those within every limit on the way and at the end; null where none is stated or gathered.
const Share* kept_share(const SweepCell& cell);

/// The capacity with its interval, or the least and the largest, with their cells.
std::string answer_sentence(const CapacityResult& result);

/// The part of the slice that ends balanced.
std::string answer_sentence(const BasinSlice& map);

/// Keys of the study's uncertain values, except those that are `set` otherwise.
std::vector<std::string> drawn_keys(const Study& study, const std::vector<std::string>& set = {});

/// "With unbalance and rotor damping sampled for each run, the rotor ends ..."; just the sentence without keys.
std::string after_what_is_drawn(std::vector<std::string> keys, std::string sentence);

/// A limit that a study has.
struct ToldLimit {
  std::size_t place;  ///< in TransientGroup::exceeded
  std::string words;  ///< "5 mm is exceeded on the way"
};
std::vector<ToldLimit> told_limits(const Study& study);

}  // namespace equipoise
