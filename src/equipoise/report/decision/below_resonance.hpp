// Why a rotor below its critical speed needs no balancer, in words.
#pragma once

#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Says why, and that no start has to be followed to know it.
inline constexpr char leave_balancer_out[] = "Leave the balancer out: {}.";
inline constexpr char by_linear_theory[] = "By linear theory; no start has to be followed for that.";

/// "the rotor runs at 1000 rpm, below its critical speed of ...", to follow "Leave the balancer out: "; empty unless
/// runs_below_resonance().
std::string below_resonance_words(const Study& study);

}  // namespace equipoise
