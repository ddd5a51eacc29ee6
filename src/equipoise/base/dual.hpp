// Dual numbers a + b eps (eps^2 = 0): run the equations on them and b is an exact derivative.
// A number type of the equations (see pack-inl.hpp for what that asks).
#pragma once

#include <cmath>

namespace equipoise {

struct Dual {
  double value = 0.0, slope = 0.0;

  Dual() = default;
  Dual(double v, double s = 0.0) : value(v), slope(s) {}

  friend Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.slope + b.slope}; }
  friend Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.slope - b.slope}; }
  friend Dual operator-(Dual a) { return {-a.value, -a.slope}; }
  friend Dual operator*(Dual a, Dual b) { return {a.value * b.value, a.slope * b.value + a.value * b.slope}; }
  friend Dual operator/(Dual a, Dual b) {
    return {a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value)};
  }
};

inline Dual multiply_add(Dual a, Dual b, Dual c) { return a * b + c; }
inline void sin_cos(Dual a, Dual& sine, Dual& cosine) {
  const double s = std::sin(a.value), c = std::cos(a.value);
  sine = {s, c * a.slope};
  cosine = {c, -s * a.slope};
}

}  // namespace equipoise
