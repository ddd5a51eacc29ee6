// A value with its partial derivatives in n directions, over any number type. Run on it, the equations give exact
// derivatives; over intervals, bounds on a derivative over a whole box. A number type of the equations
// (core/base/pack-inl.hpp).
#pragma once

#include <cmath>
#include <type_traits>

namespace equipoise {

template <class T, int n>
struct Gradient {
  T value{}, slope[n]{};

  Gradient() = default;
  Gradient(double v) : value(v) {}
  /// Variable number `direction`.
  Gradient(T v, int direction) : value(v) { slope[direction] = T(1.0); }

  friend Gradient operator+(const Gradient& a, const Gradient& b) {
    Gradient r;
    r.value = a.value + b.value;
    for (int k = 0; k < n; ++k) r.slope[k] = a.slope[k] + b.slope[k];
    return r;
  }
  friend Gradient operator-(const Gradient& a) {
    Gradient r;
    r.value = -a.value;
    for (int k = 0; k < n; ++k) r.slope[k] = -a.slope[k];
    return r;
  }
  friend Gradient operator-(const Gradient& a, const Gradient& b) { return a + (-b); }
  friend Gradient operator*(const Gradient& a, const Gradient& b) {
    Gradient r;
    r.value = a.value * b.value;
    for (int k = 0; k < n; ++k) r.slope[k] = a.slope[k] * b.value + a.value * b.slope[k];
    return r;
  }
  friend Gradient operator/(const Gradient& a, const Gradient& b) {
    Gradient r;
    r.value = a.value / b.value;
    if constexpr (std::is_same_v<T, double>) {
      const double inverse = 1.0 / b.value;
      for (int k = 0; k < n; ++k) r.slope[k] = (a.slope[k] - r.value * b.slope[k]) * inverse;
    } else {  // an interval's inverse would widen the result
      for (int k = 0; k < n; ++k) r.slope[k] = (a.slope[k] - r.value * b.slope[k]) / b.value;
    }
    return r;
  }
  // Values alone are compared: they decide which branch of the equations holds.
  friend bool operator<(const Gradient& a, const Gradient& b) { return a.value < b.value; }
  friend Gradient select(bool m, const Gradient& yes, const Gradient& no) { return m ? yes : no; }
  friend Gradient absolute(const Gradient& a) { return a.value < 0.0 ? -a : a; }
  friend Gradient minimum(const Gradient& a, const Gradient& b) { return b < a ? b : a; }
  friend Gradient multiply_add(const Gradient& a, const Gradient& b, const Gradient& c) { return a * b + c; }
};

inline void sin_cos(double a, double& sine, double& cosine) {
  sine = std::sin(a);
  cosine = std::cos(a);
}

template <class T, int n>
void sin_cos(const Gradient<T, n>& a, Gradient<T, n>& sine, Gradient<T, n>& cosine) {
  const Gradient<T, n> from = a;  // `a` may be one of the results
  T s, c;
  sin_cos(from.value, s, c);
  sine.value = s;
  cosine.value = c;
  for (int k = 0; k < n; ++k) {
    sine.slope[k] = c * from.slope[k];
    cosine.slope[k] = -(s * from.slope[k]);
  }
}

}  // namespace equipoise
