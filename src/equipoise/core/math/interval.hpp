// Intervals certain to contain the exact result: the number type of machine-checked proofs.
//
// A number type of the equations (requirements: core/base/pack-inl.hpp). Every operation rounds to nearest, then moves
// outwards by a relative 2^-52 and an absolute 2^-1074. That is twice the largest rounding error, so contraction into
// fused multiply-adds does no harm. Needs round-to-nearest and no -ffast-math. NaN, as after division by an interval
// that contains 0, becomes the whole line.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/core/math/proven_sine.hpp"

#ifdef __FAST_MATH__
#error interval.hpp: -ffast-math breaks the outward rounding that proofs rest on
#endif

namespace equipoise {

/// Lower and upper bounds on the exact result of an operation whose rounded result was `t`.
inline double rounded_down(double t) {
  return t - (0x1p-52 * std::fabs(t) + std::numeric_limits<double>::denorm_min());
}
inline double rounded_up(double t) { return t + (0x1p-52 * std::fabs(t) + std::numeric_limits<double>::denorm_min()); }

struct Interval {
  double low = 0.0, high = 0.0;

  Interval() = default;
  Interval(double v) : low(v), high(v) {}
  Interval(double l, double h) : low(l), high(h) {}

  static Interval whole() {
    return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }

  double middle() const { return 0.5 * low + 0.5 * high; }
  /// No point of the interval is further than this from middle().
  double radius() const {
    const double m = middle();
    return rounded_up(std::max(high - m, m - low));
  }
  double magnitude() const { return std::max(std::fabs(low), std::fabs(high)); }
  bool contains(double v) const { return low <= v && v <= high; }

  friend Interval operator+(Interval a, Interval b) { return outward(a.low + b.low, a.high + b.high); }
  friend Interval operator-(Interval a, Interval b) { return outward(a.low - b.high, a.high - b.low); }
  friend Interval operator-(Interval a) { return {-a.high, -a.low}; }
  friend Interval operator*(Interval a, Interval b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    if (std::isnan(p + q + r + s)) return whole();  // min and max may miss a NaN
    return outward(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }
  friend Interval operator/(Interval a, Interval b) {
    if (!(b.low > 0.0 || b.high < 0.0)) return whole();
    const double p = a.low / b.low, q = a.low / b.high, r = a.high / b.low, s = a.high / b.high;
    if (std::isnan(p + q + r + s)) return whole();
    return outward(std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s)));
  }

 private:
  static Interval outward(double l, double h) {
    const Interval result{rounded_down(l), rounded_up(h)};
    return result.low <= result.high ? result : whole();
  }
};

inline Interval multiply_add(Interval a, Interval b, Interval c) { return a * b + c; }

inline Interval hull(Interval a, Interval b) { return {std::min(a.low, b.low), std::max(a.high, b.high)}; }

inline Interval square(Interval a) {
  const Interval product = a * a;
  if (a.contains(0.0)) return {0.0, product.high};
  return {std::max(0.0, product.low), product.high};
}

/// Square root of the non-negative part of `a`.
inline Interval square_root(Interval a) {
  return {std::max(0.0, rounded_down(std::sqrt(std::max(0.0, a.low)))), rounded_up(std::sqrt(a.high))};
}

/// Sine and cosine of one double: -1 to 1 beyond most_for_proven_sine. Two outward steps hold an error of 2^-52, and
/// what rounding them may take.
inline void sin_cos_of_number(double a, Interval& sine, Interval& cosine) {
  sine = cosine = {-1.0, 1.0};
  if (!(std::fabs(a) <= most_for_proven_sine)) return;
  const ProvenSine proven = proven_sine(a);
  const auto enclosed = [&](double v) {
    return Interval{std::max(-1.0, rounded_down(rounded_down(v - proven.absolute))),
                    std::min(1.0, rounded_up(rounded_up(v + proven.absolute)))};
  };
  sine = enclosed(proven.sine);
  cosine = enclosed(proven.cosine);
}

/// The hull of the values at both ends and of every extremum k pi/2 that may lie between them.
inline void sin_cos(Interval a, Interval& sine, Interval& cosine) {
  constexpr double quarter_low = 0x1.921fb54442d18p+0, quarter_high = 0x1.921fb54442d19p+0;  // enclose pi/2
  constexpr double largest = most_for_proven_sine;
  sine = cosine = {-1.0, 1.0};
  if (!(a.low >= -largest && a.high <= largest && a.high - a.low < 6.0)) return;
  Interval sine_high, cosine_high;
  sin_cos_of_number(a.low, sine, cosine);
  sin_cos_of_number(a.high, sine_high, cosine_high);
  sine = hull(sine, sine_high);
  cosine = hull(cosine, cosine_high);
  const double last = std::ceil(a.high / quarter_low) + 1.0;
  for (double k = std::floor(a.low / quarter_low) - 1.0; k <= last; k += 1.0) {
    const Interval extremum = Interval(k) * Interval(quarter_low, quarter_high);
    if (extremum.high < a.low || extremum.low > a.high) continue;
    const int quadrant = static_cast<int>(k - 4.0 * std::floor(0.25 * k));
    const double value = quadrant < 2 ? 1.0 : -1.0;  // sin at odd k, cos at even k
    Interval& reached = quadrant % 2 == 1 ? sine : cosine;
    reached = hull(reached, Interval(value));
  }
}

}  // namespace equipoise
