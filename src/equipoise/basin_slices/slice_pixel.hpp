// What pixels of a map begin with, and how those who follow them hand on what they came to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "equipoise/attractors/motion.hpp"
#include "equipoise/results/basin_slice.hpp"

namespace equipoise {

/// Pixels that are done, and of each the motion that it came to or null; codes of those are given by whoever takes
/// them.
struct DonePixels {
  std::vector<std::uint32_t> positions;
  std::vector<SlicePixel> pixels;
  std::vector<const MotionName*> motions;
};
/// Called by one thread at a time.
using TakePixels = std::function<void(const DonePixels&)>;

/// Puts the balls that follow others where these are, tie by tie.
inline void tie(InitialState& start, const std::vector<AngleLink>& links) {
  for (const AngleLink& link : links)
    start.phi[static_cast<std::size_t>(link.ball - 1)] = start.phi[static_cast<std::size_t>(link.of - 1)] + link.offset;
}

}  // namespace equipoise
