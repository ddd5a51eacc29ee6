// The distributions behind intervals and tests.
#pragma once

#include <cstdint>

namespace equipoise {

/// z such that a standard normal variable lies between -z and z with probability `confidence` (0 < confidence < 1).
double normal_half_width(double confidence);

/// For a standard normal variable; 0 < probability < 1.
double normal_quantile(double probability);
double normal_up_to(double value);

/// normal_half_width() of Student's t; `freedom` > 0 need not be a whole number.
double students_t_half_width(double freedom, double confidence);

/// Of the gamma distribution with scale 1; `shape` > 0, 0 < probability < 1.
double gamma_quantile(double shape, double probability);

/// How many of `trials` succeed if each does so with `probability`.
struct Binomial {
  double trials, probability;

  /// P(K = k).
  double mass(std::uint64_t k) const;
  /// P(K <= k).
  double up_to(std::uint64_t k) const;
  /// P(K > k), accurate where it is tiny.
  double above(std::uint64_t k) const;
};

}  // namespace equipoise
