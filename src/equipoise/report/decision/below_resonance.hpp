// Why a rotor below its critical speed needs no balancer, in words.
#pragma once

#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// "the rotor runs at 1000 rpm, below its critical speed of ...", to follow "Leave the balancer out: "; empty unless
/// runs_below_resonance().
std::string below_resonance_words(const Study& study);

}  // namespace equipoise
