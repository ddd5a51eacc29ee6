// An attractor of one study: its motion under an identifier and a name.
#pragma once

#include <optional>
#include <string>

#include "equipoise/results/types/motion.hpp"

namespace equipoise {

/// Which part of a continuum attracts: members drawn evenly among all ball angles that balance.
struct ContinuumPart {
  int drawn = 0, stable = 0;                      ///< stable across the continuum
  double slowest_rate = 0.0, fastest_rate = 0.0;  ///< range of the slowest rate of stable members (negative)
  double least_growth = 0.0, most_growth = 0.0;   ///< range of the growth rates of the others
  double share() const { return drawn ? static_cast<double>(stable) / drawn : 0.0; }
};

struct Attractor {
  int id = 0;               ///< from 1; the same for the same motion wherever a motion has an identifier of its own
  std::string name, alias;  ///< alias: V1 to V4, as Wright and Peng (2019) call them
  Motion motion;
  /// Of the balanced states of three balls or more; `motion` then describes one of them, an attracting one if any does.
  std::optional<ContinuumPart> continuum = {};
};

/// First identifier for motions without one of their own (motion_name()).
inline constexpr int first_free_id = 8;

}  // namespace equipoise
