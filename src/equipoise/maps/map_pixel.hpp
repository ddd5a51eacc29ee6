// What pixels of a map begin with, and what they came to before motions without an identifier of their own get codes.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "equipoise/motions/motion.hpp"
#include "equipoise/results/plane_map.hpp"

namespace equipoise {

struct MapPixel {
  short code = not_computed_code;  ///< of what is no motion
  /// The motion that it came to, with its own identifier or 0; shared, since maps are large.
  std::shared_ptr<const MotionName> motion = nullptr;
  double time = std::numeric_limits<double>::quiet_NaN(), r_max = time;
};

/// Puts the balls that follow others where these are, tie by tie.
inline void tie(InitialState& start, const std::vector<AngleLink>& links) {
  for (const AngleLink& link : links)
    start.phi[static_cast<std::size_t>(link.ball - 1)] = start.phi[static_cast<std::size_t>(link.of - 1)] + link.offset;
}

}  // namespace equipoise
