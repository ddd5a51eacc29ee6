// Default times at which a trajectory is sampled.
#pragma once

#include <optional>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// Later, a double no longer resolves the rotor's angle.
inline constexpr double last_output_time = 1e9;
inline constexpr double most_output_rows = 1e8;

/// Times for simulate(): 0 and on, `every` apart, until `until`. Unset: until 100 after the last branch has begun and
/// the balls are free; a hundred intervals. Throws InputError for an invalid study, for times that are none, and for
/// more than most_output_rows of them.
std::vector<double> output_times(const Study& study, std::optional<double> until = {},
                                 std::optional<double> every = {});

}  // namespace equipoise
