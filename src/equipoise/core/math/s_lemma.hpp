// The S-lemma: a quadratic function is negative on a ball if some multiple of (squared radius - |eta|^2) can be added
// and leaves it negative everywhere (Yakubovich, 1971; Polik and Terlaky, "A survey of the S-lemma", SIAM Rev. 49
// (2007) 371). One multiplier serves several functions: here one for each corner of a box.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "equipoise/core/math/positive_definite.hpp"

namespace equipoise {

/// (eta, 1)^T form (eta, 1), lower triangle with 1 last; it should be negative where |eta|^2 <= room.
template <std::size_t side>
struct QuadraticOnBall {
  std::array<std::array<double, side>, side> form;
  double room;
};

enum class Multiplier { proves, too_small, too_large };

/// Whether `multiplier` >= 0 proves it, rounding included. If not, any multiplier that does lies beyond `bound`. There
/// the tangent at 1 of the form's Schur complement, convex in the multiplier, vanishes; it guides the search.
template <std::size_t side>
Multiplier judge(const QuadraticOnBall<side>& f, double multiplier, double& bound) {
  constexpr std::size_t one = side - 1;
  std::array<std::array<double, side>, side> a;
  for (std::size_t i = 0; i < side; ++i)
    for (std::size_t j = 0; j <= i; ++j) a[i][j] = -f.form[i][j];
  for (std::size_t j = 0; j < one; ++j) a[j][j] = rounded_down(a[j][j] + multiplier);
  a[one][one] = rounded_down(a[one][one] - rounded_up(multiplier * f.room));
  const double slack = trace_slack(a);
  for (std::size_t j = 0; j < side; ++j) a[j][j] -= slack;
  bound = multiplier;
  if (!factorise(a, one)) return Multiplier::too_small;
  double complement = a[one][one];
  for (std::size_t k = 0; k < one; ++k) complement -= a[one][k] * a[one][k];
  if (complement > 0.0) return Multiplier::proves;
  std::array<double, one> eta;  // where the function is largest
  double length = 0.0;
  for (std::size_t i = one; i-- > 0;) {
    eta[i] = a[one][i];
    for (std::size_t k = i + 1; k < one; ++k) eta[i] -= a[k][i] * eta[k];
    eta[i] /= a[i][i];
    length += eta[i] * eta[i];
  }
  const double slope = f.room - length;
  bound = multiplier + complement / slope;
  return slope < 0.0 ? Multiplier::too_small : Multiplier::too_large;
}

/// Searches from the given multiplier for one that proves all functions. Each function admits an interval of
/// multipliers; [low, high] shrinks to their intersection, and is empty once two functions or tangents disagree.
template <std::size_t side, std::size_t count>
bool find_multiplier(const std::array<QuadraticOnBall<side>, count>& functions, double& multiplier) {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  for (int attempt = 0; attempt < 60; ++attempt) {
    bool proved = true;
    for (const auto& f : functions) {
      double bound;
      const Multiplier found = judge(f, multiplier, bound);
      if (found == Multiplier::proves) continue;
      proved = false;
      if (!std::isfinite(bound)) return false;
      if (found == Multiplier::too_small)
        low = std::max(low, bound);
      else
        high = std::min(high, bound);
    }
    if (proved) return true;
    if (!(low < high)) return false;
    if (std::isinf(high))
      multiplier = std::max(2.0 * low, 1e-6);
    else if (low == 0.0)
      multiplier = high > 1e-9 ? 0.25 * high : 0.0;
    else
      multiplier = std::sqrt(low * high);
  }
  return false;
}

}  // namespace equipoise
