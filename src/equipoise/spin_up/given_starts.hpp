// Starts of the caller's own, in place of drawn ones.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// Throws InputError for a study whose starts draw their rotors too.
void check_takes_starts(const Study& study);

/// Throws InputError, naming the first of them, for states that no start of the study can have at t = 0: numbers that
/// are not finite, angles or rates of balls that there are not, or what starts of this study have in common (see
/// BasinOptions::initial); balls that overlap. `study` has passed check().
void check_given_starts(const Study& study, std::span<const InitialState> given);

/// Of all that they are, to the bit.
std::string checksum_of(const Study& study, std::span<const InitialState> given);

}  // namespace equipoise
