// Starts given by the caller.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for a study with uncertain values.
void check_takes_starts(const Study& study);

/// Throws InputError, naming the start, for numbers that are not finite, values of balls that the study lacks, values
/// that all starts must share (see BasinOptions::initial), and overlapping balls. `study` must have passed check().
void check_given_starts(const Study& study, std::span<const InitialState> given);

/// Bitwise checksum of the initial states.
std::string checksum_of(const Study& study, std::span<const InitialState> given);

}  // namespace equipoise
