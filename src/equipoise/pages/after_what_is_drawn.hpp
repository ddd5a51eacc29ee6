// The begin of an answer about a study with uncertain values.
#pragma once

#include <string>
#include <vector>

namespace equipoise {

/// "With unbalance and rotor damping drawn anew for every start, the rotor ends ..."; the sentence itself if
/// there are no keys.
std::string after_what_is_drawn(std::vector<std::string> keys, std::string sentence);

}  // namespace equipoise
