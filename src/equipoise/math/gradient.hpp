// A value with its partial derivatives in n directions, over any number type: on intervals, bounds on a derivative over
// a whole box. A number type of the equations (see pack-inl.hpp for what that asks).
#pragma once

namespace equipoise {

template <class T, int n>
struct Gradient {
  T value{}, slope[n]{};

  Gradient() = default;
  Gradient(double v) : value(v) {}
  /// The variable number `direction`.
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
    for (int k = 0; k < n; ++k) r.slope[k] = (a.slope[k] - r.value * b.slope[k]) / b.value;
    return r;
  }
};

template <class T, int n>
void sin_cos(const Gradient<T, n>& a, Gradient<T, n>& sine, Gradient<T, n>& cosine) {
  T s, c;
  sin_cos(a.value, s, c);
  sine.value = s;
  cosine.value = c;
  for (int k = 0; k < n; ++k) {
    sine.slope[k] = c * a.slope[k];
    cosine.slope[k] = -(s * a.slope[k]);
  }
}

}  // namespace equipoise
