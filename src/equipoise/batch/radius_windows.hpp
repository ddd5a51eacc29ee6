// A record of displacement: the largest and the last r^2 of every trajectory in windows of time.
#pragma once

#include <cstddef>

namespace equipoise {

/// Two tables of count x windows numbers, row-major. Window k is [k width, (k + 1) width]. Tasks over successive
/// segments of one motion may share them: a window's largest r^2 only grows, and a lost trajectory's stays infinite.
struct RadiusWindows {
  double width = 0.0;       ///< > 0
  std::size_t windows = 0;  ///< per trajectory; later ones are not recorded
  float* largest = nullptr;
  float* at_end = nullptr;
};

}  // namespace equipoise
