// Dual numbers a + sum b_k eps_k (eps_i eps_k = 0): run the equations on them and the b_k are exact derivatives, in as
// many directions at once as there are slopes. With the slopes of the state set to tangent vectors, the slopes of dz/dt
// are those of the variational equations.
// A number type of the equations (see pack-inl.hpp for what that asks).
#pragma once

#include <cmath>

namespace equipoise {

template <int slopes>
struct Dual {
  double value = 0.0;
  double slope[slopes] = {};

  Dual() = default;
  Dual(double v) : value(v) {}

  friend Dual operator+(const Dual& a, const Dual& b) {
    return combine(a.value + b.value, [&](int k) { return a.slope[k] + b.slope[k]; });
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return combine(a.value - b.value, [&](int k) { return a.slope[k] - b.slope[k]; });
  }
  friend Dual operator-(const Dual& a) {
    return combine(-a.value, [&](int k) { return -a.slope[k]; });
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return combine(a.value * b.value, [&](int k) { return a.slope[k] * b.value + a.value * b.slope[k]; });
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double inverse = 1.0 / b.value, quotient = a.value / b.value;
    return combine(quotient, [&](int k) { return (a.slope[k] - quotient * b.slope[k]) * inverse; });
  }
  // By their values: which branch of the equations holds.
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend Dual select(bool m, const Dual& yes, const Dual& no) { return m ? yes : no; }
  friend Dual absolute(const Dual& a) { return a.value < 0.0 ? -a : a; }
  friend Dual minimum(const Dual& a, const Dual& b) { return b < a ? b : a; }
  friend Dual multiply_add(const Dual& a, const Dual& b, const Dual& c) { return a * b + c; }
  friend void sin_cos(const Dual& a, Dual& sine, Dual& cosine) {
    const double s = std::sin(a.value), c = std::cos(a.value);
    const Dual from = a;  // `a` may be one of the results
    sine = combine(s, [&](int k) { return c * from.slope[k]; });
    cosine = combine(c, [&](int k) { return -s * from.slope[k]; });
  }

 private:
  template <class Slope>
  static Dual combine(double value, Slope&& slope_at) {
    Dual result(value);
    for (int k = 0; k < slopes; ++k) result.slope[k] = slope_at(k);
    return result;
  }
};

}  // namespace equipoise
