// The known name that somebody meant who wrote another.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace equipoise {

/// Of ASCII; other letters stay.
std::string in_small_letters(std::string_view text);

/// Whether `names`, which blanks separate, hold `name`.
bool is_among(std::string_view names, std::string_view name);

/// The nearest of `known` whose letters differ at most in two places and in less than half of `given`, small and
/// capital letters being alike; empty if there is none.
std::string nearest_name(std::string_view given, const std::vector<std::string>& known);

/// "did you mean "ramp"? ", for the words before "must be", or nothing.
std::string did_you_mean(std::string_view given, const std::vector<std::string>& known);

}  // namespace equipoise
