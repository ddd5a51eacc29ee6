// What an ensemble costs.
#pragma once

#include <cstdint>

namespace equipoise {

/// In seconds of CPU, summed over threads, on the machine that measured them.
struct BasinCost {
  std::uint64_t starts = 0;    ///< that the study asks for
  double search = 0.0;         ///< for attractors; if it was cut off, what it had taken by then
  bool search_ended = false;   ///< else what starts take is not known
  double a_start = 0.0;        ///< in the mean of those measured
  std::uint64_t measured = 0;  ///< starts

  double total() const { return search + static_cast<double>(starts) * a_start; }
};

}  // namespace equipoise
