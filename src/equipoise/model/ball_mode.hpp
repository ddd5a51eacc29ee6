// What each ball of a rotor with contact or dry friction does between two events.
#pragma once

#include <array>

#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Pair k: the ball in place k around the race and the next one.
struct BallMode {
  std::array<bool, max_balls> held{};     ///< at rest in the race, by stiction or by the clamp
  std::array<int, max_balls> sense{};     ///< -1, 1: in which a ball moves, or starts, against its rolling resistance
  std::array<bool, max_balls> joined{};   ///< pair k: they touch, and move or rest as one
  std::array<int, max_balls> order{};     ///< of the balls around the race
  std::array<double, max_balls> turns{};  ///< pair k: what its second ball's angle lacks to be the next ahead

  bool operator==(const BallMode&) const = default;
};

}  // namespace equipoise::model
