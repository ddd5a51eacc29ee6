// What an ensemble answers, in one sentence.
#pragma once

#include <string>

#include "equipoise/results/basin_result.hpp"

namespace equipoise {

/// "97.1 to 98.9 %", "less than 1.9 %", "more than 98.1 %": 95 % interval of a share.
std::string share_words(const Share& share);

/// "The rotor ends balanced in 97.1 to 98.9 % of starts (95 % confidence); 5 mm is exceeded on the way in 1.6 to 2.5
/// %." Undecided starts are said, and bounds that hold whatever they come to; limits that the study does not have are
/// not.
std::string answer_sentence(const BasinResult& result);

}  // namespace equipoise
