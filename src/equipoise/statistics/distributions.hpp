// Distributions that intervals and tests are made of.
#pragma once

#include <cstdint>

namespace equipoise {

/// z such that a standard normal variable lies between -z and z with probability `confidence` (0 < confidence < 1).
double normal_half_width(double confidence);

/// The value below which a standard normal variable lies with `probability` (0 < probability < 1), and the probability
/// with which it lies below a value.
double normal_quantile(double probability);
double normal_up_to(double value);

/// The same as normal_half_width() of Student's t with `freedom` > 0 degrees of freedom, not necessarily a whole
/// number.
double students_t_half_width(double freedom, double confidence);

/// How many of `trials` succeed if each does with `probability`.
struct Binomial {
  double trials, probability;

  /// P(K = k).
  double mass(std::uint64_t k) const;
  /// P(K <= k).
  double up_to(std::uint64_t k) const;
  /// P(K > k), exact where it is tiny.
  double above(std::uint64_t k) const;
};

}  // namespace equipoise
