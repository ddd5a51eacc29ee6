// A chart of two parameters: curves on which balance changes, and boxes in which it is proved.
// This room: curves in a plane on which balance, locked states and cycles change, and how balance is lost there.
#pragma once

#include <cstdint>

#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/extras/stability/over_plane.hpp"

namespace equipoise {

/// Over the grid of StabilitySettings. Progress is in points of the grid, then in cycles.
struct ChartSettings : StabilitySettings {
  std::uint64_t boxes = 200000;  ///< the most that are judged; 0: nothing is proved
  double undecided = 0.01;       ///< the part of the plane at which proofs may end
  bool cycles = false;           ///< also look for curves of cycles, which takes longer than all else
};

/// Curves begin where neighbours of the grid differ, at the changes next to the study's own values, and between boxes
/// that are proved to be stable and unstable; one that passes between all these is not found. Throws InputError as
/// stability() does, and for a study without curves (model::ResultKind::curves).
BifurcationChart bifurcation_chart(const Study& study, const ChartSettings& settings);

}  // namespace equipoise
