// Proof that two equations have exactly one common zero nearby, with its place (Krawczyk, Computing 4 (1969) 187).
#pragma once

#include <array>

#include "equipoise/core/math/gradient.hpp"
#include "equipoise/core/math/interval.hpp"

namespace equipoise {

using PlaneGradient = Gradient<Interval, 2>;

/// Finds a box around `near`, at most `widest` away in either variable, that contains exactly one zero of f. f maps two
/// PlaneGradient to two. With Y about f'(m)^-1, the operator K(X) = m - Y f(m) + (1 - Y f'(X)) (X - m) maps a box X
/// into its own interior only if there is exactly one. False if no such box is found.
template <class F>
bool enclose_zero(F&& f, const std::array<double, 2>& near, double widest, std::array<Interval, 2>& zero) {
  const auto at = [&](const std::array<Interval, 2>& x) {
    return f(std::array<PlaneGradient, 2>{PlaneGradient(x[0], 0), PlaneGradient(x[1], 1)});
  };
  const std::array<Interval, 2> middle{Interval(near[0]), Interval(near[1])};
  const std::array<PlaneGradient, 2> value = at(middle);
  const double a = value[0].slope[0].middle(), b = value[0].slope[1].middle(), c = value[1].slope[0].middle(),
               d = value[1].slope[1].middle(), determinant = a * d - b * c;
  const double inverse[2][2] = {{d / determinant, -b / determinant}, {-c / determinant, a / determinant}};
  for (double radius = 0x1p-46; radius <= widest; radius *= 4.0) {
    const Interval around{-radius, radius};
    const std::array<PlaneGradient, 2> range = at({middle[0] + around, middle[1] + around});
    bool inside = true;
    for (int i = 0; i < 2; ++i) {
      Interval image = -(Interval(inverse[i][0]) * value[0].value + Interval(inverse[i][1]) * value[1].value);
      for (int k = 0; k < 2; ++k) {
        const Interval slope =
            Interval(inverse[i][0]) * range[0].slope[k] + Interval(inverse[i][1]) * range[1].slope[k];
        image = image + (Interval(i == k ? 1.0 : 0.0) - slope) * around;
      }
      inside = inside && image.low > -radius && image.high < radius;
      zero[i] = middle[i] + image;
    }
    if (inside) return true;
  }
  return false;
}

}  // namespace equipoise
