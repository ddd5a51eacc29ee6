// How starts begin, in words: held balls, unused parts of [initial], balls in one place.
#pragma once

#include <string>
#include <vector>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// "balls held until t = 40, the end of the ramp"; empty if they are free from the start.
std::string release_text(const Study& study);

/// Keys of [initial] that the study states but an ensemble draws: initial.phi, and those in [sampling.box].
std::vector<std::string> drawn_instead(const Study& study);
/// The same as a sentence with a line end; empty if there are none.
std::string drawn_instead_text(const Study& study);

/// "balls 1 and 2 are alike and start in one place: ..."; empty if there are none.
std::string coincident_text(const Study& study);

}  // namespace equipoise
