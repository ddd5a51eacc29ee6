// How starts begin, in words: balls that are held, what of [initial] nobody uses, balls in one place.
#pragma once

#include <string>
#include <vector>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// "balls held until t = 40, the end of the ramp"; empty if they are free from the first.
std::string held_text(const Study& study);

/// Keys of [initial] that the study states and an ensemble draws instead: initial.phi, and those in [sampling.box].
std::vector<std::string> drawn_instead(const Study& study);
/// The same in a sentence, with the end of its line; empty if there are none.
std::string drawn_instead_text(const Study& study);

/// "balls 1 and 2 are alike and start in one place: ..."; empty if there are none.
std::string coincident_text(const Study& study);

}  // namespace equipoise
