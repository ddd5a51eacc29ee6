// The mode of the balls between two events of a system with contact or dry friction: held, sliding, joined.
#pragma once

#include <array>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Pair k: the ball in place k around the race and the next one.
struct BallMode {
  std::array<bool, max_balls> held{};     ///< at rest in the race, by stiction or by the clamp
  std::array<int, max_balls> sense{};     ///< -1 or 1: direction in which a ball moves or starts; resistance opposes it
  std::array<bool, max_balls> joined{};   ///< pair k: they touch, and move or rest as one
  std::array<int, max_balls> order{};     ///< the balls in their order around the race
  std::array<double, max_balls> turns{};  ///< pair k: whole turns, in rad, that put its second ball next ahead

  bool operator==(const BallMode&) const = default;
};

}  // namespace equipoise::model
