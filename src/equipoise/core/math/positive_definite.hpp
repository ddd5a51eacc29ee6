// Positive definiteness of matrices, proved despite rounding.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "equipoise/core/math/interval.hpp"

namespace equipoise {

/// Cholesky's factor of the leading `count` rows of `a`, in its lower triangle. False if a pivot is not positive.
template <std::size_t rows>
bool factorise(std::array<std::array<double, rows>, rows>& a, int count) {
  for (int j = 0; j < count; ++j) {
    double pivot = a[j][j];
    for (int k = 0; k < j; ++k) pivot -= a[j][k] * a[j][k];
    if (!(pivot > 0.0)) return false;
    const double root = std::sqrt(pivot), inverse = 1.0 / root;
    a[j][j] = root;
    for (int i = j + 1; i < static_cast<int>(rows); ++i) {
      double sum = a[i][j];
      for (int k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = sum * inverse;
    }
  }
  return true;
}

/// If a Cholesky factorisation in doubles succeeds after this is subtracted from the diagonal, `a` is positive
/// definite. For k rows it is (k + 1) u / (1 - (k + 1) u) times the trace (Rump, "Verification of positive
/// definiteness", BIT 46 (2006) 433). 2^-46 is 128 u: enough for thirty rows and for multiplying by a pivot's inverse,
/// which costs another u per row.
template <std::size_t rows>
double trace_slack(const std::array<std::array<double, rows>, rows>& a) {
  double trace = 0.0;
  for (std::size_t i = 0; i < rows; ++i) trace += std::fabs(a[i][i]);
  return 0x1p-46 * trace;
}

/// Whether every symmetric matrix within the intervals of `a` is positive definite. An off-diagonal radius changes a
/// quadratic form by at most itself times the mean square of its two components.
template <std::size_t rows>
bool certainly_positive(const std::array<std::array<Interval, rows>, rows>& a, double spare) {
  std::array<std::array<double, rows>, rows> lower{};
  for (std::size_t i = 0; i < rows; ++i) {
    Interval diagonal = a[i][i];
    for (std::size_t j = 0; j < rows; ++j) {
      const Interval& entry = j < i ? a[i][j] : a[j][i];
      if (j != i) diagonal = diagonal - Interval(entry.radius());
      diagonal = diagonal - Interval(spare) * Interval(entry.magnitude());
      if (j < i) lower[i][j] = entry.middle();
    }
    lower[i][i] = diagonal.low;
  }
  const double slack = trace_slack(lower);
  for (std::size_t i = 0; i < rows; ++i) lower[i][i] -= slack;
  return factorise(lower, static_cast<int>(rows));
}

}  // namespace equipoise
