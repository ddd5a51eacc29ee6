// Default times at which a trajectory is sampled.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Beyond this, a double no longer resolves the rotor's angle.
inline constexpr double last_output_time = 1e9;
inline constexpr double most_output_rows = 1e8;

/// Times for simulate(): from 0 in steps of `every` up to `until`. Unset: until 100 after the last piece has begun and
/// the balls are free; a hundred intervals. Throws InputError for an invalid study, for invalid times, and for more
/// than most_output_rows of them.
std::vector<double> output_times(const Study& study, std::optional<double> until = {},
                                 std::optional<double> every = {});

}  // namespace equipoise
