// How pixels of a slice start, and how their results are passed on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Finished pixels, each with the motion that it came to, or null. The receiver gives codes to these motions.
struct DonePixels {
  std::vector<std::uint32_t> positions;
  std::vector<SlicePixel> pixels;
  std::vector<const MotionName*> motions;
};
/// Called by one thread at a time.
using TakePixels = std::function<void(const DonePixels&)>;

/// Places linked balls, link by link.
inline void tie(InitialState& start, const std::vector<AngleLink>& links) {
  for (const AngleLink& link : links)
    start.phi[static_cast<std::size_t>(link.ball - 1)] = start.phi[static_cast<std::size_t>(link.of - 1)] + link.offset;
}

}  // namespace equipoise
