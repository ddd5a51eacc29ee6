// What the reading of studies and what follows from them have in common.
#pragma once

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/mechanics/words.hpp"

namespace equipoise::model {

/// Why a release at some speed is refused; `shown` writes a speed.
template <class Shown>
std::string never_reached(const SpeedProfile& profile, Shown&& shown) {
  const auto [low, high] = std::minmax_element(profile.speeds.begin(), profile.speeds.end());
  return fmt::format("the ramp function never reaches it; must be from {} to {}", shown(*low), shown(*high));
}

}  // namespace equipoise::model
