// Starts given by the caller.
#pragma once

#include <span>
#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Throws InputError for a study with uncertain values.
void check_takes_starts(const Study& study);

/// Throws InputError, naming the start, for overlapping balls and for numbers that are not finite. Also for values of
/// balls that the study lacks, and values that all starts share (BasinOptions::initial). `study` has passed check().
void check_given_starts(const Study& study, std::span<const InitialState> given);

/// Bitwise checksum of the initial states.
std::string checksum_of(const Study& study, std::span<const InitialState> given);

}  // namespace equipoise
