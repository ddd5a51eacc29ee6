// How fast something ends that ends at random, from how often it did while it was watched.
#pragma once

#include <cstdint>

namespace equipoise {

/// A constant rate at which each of many watched trajectories leaves, whatever it did before.
struct EscapeRate {
  std::uint64_t escapes = 0, trajectories = 0;   ///< how many left, of those watched
  double watched = 0.0;                          ///< time, summed over trajectories; above 0
  double rate = 0.0, low = 0.0, high = 0.0;      ///< with its 95 % interval
  double median = 0.0, least = 0.0, most = 0.0;  ///< lifetime; infinite where the rate may be 0
  double watched_from = 0.0;                     ///< those that left earlier do not count
};

/// The largest-likelihood rate for lifetimes some of which are cut off. Its interval is the exact one for a Poisson
/// count (F. Garwood, Biometrika 28 (1936) 437).
EscapeRate escape_rate(std::uint64_t escapes, std::uint64_t trajectories, double watched, double confidence = 0.95);

}  // namespace equipoise
