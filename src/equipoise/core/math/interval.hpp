// Intervals certain to contain the exact result: the number type of machine-checked proofs.
//
// A number type of the equations (requirements: core/base/pack-inl.hpp). Every operation rounds to nearest, then moves
// outwards by a relative 2^-52 and an absolute 2^-1074. That is twice the largest rounding error, so contraction into
// fused multiply-adds does no harm. Needs round-to-nearest and no -ffast-math. NaN, as after division by an interval
// that contains 0, becomes the whole line.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#ifdef __FAST_MATH__
#error interval.hpp: -ffast-math breaks the outward rounding that proofs rest on
#endif

namespace equipoise {

/// Sine and cosine of one double, with an error that is proved here: no word of a C library is taken for it, and all
/// systems get the same bits. Each differs from the exact value by at most 2^-52 of its own size, plus `absolute`.
struct ProvenSine {
  double sine = 0.0, cosine = 0.0, absolute = 0.0;
};

/// Largest argument that proven_sine() takes, 2^20.
inline constexpr double most_for_proven_sine = 0x1p20;

/// For |a| <= most_for_proven_sine. With u = 2^-53:
///
/// - Reduction. k is the integer nearest to 2a/pi, |k| < 2^20. pi/2 is p1 + p2 + p3 + rest: 31, 32 and 53 bits, and
///   |rest| < 2^-122. The products k p1 and k p2 are exact, and so is a - k p1: a multiple of 2^-53 (for k = 0: a)
///   below 1. Sums are kept with their rounding errors. What is lost is at most 2^-101 of k p3, as much in adding it,
///   and 2^-102 with the rest: together less than 2^-99. So a = k pi/2 + r + low, |r| < 0.7856 and |low| <= u/2 and <=
///   u |r|.
/// - Series. Taylor's, with t = r^2 < 0.6172. What follows is below 2^-62 of sin r and 2^-67 of cos r.
/// - Sine, r + (r t P + low cos r): |r t P| < 0.103 |r| with relative error below 5.5 u; the inner sum rounds by
///   0.105 u |r|, the outer by u |sin r|. With |sin r| > 0.9 |r| this is less than 1.8 u |sin r|.
/// - Cosine, 1 - (t/2 - (t^2 Q - r low)): t/2 errs by 0.31 u, t^2 Q < 0.016 by 0.1 u, the sums round by 0.02 u, u/4
///   and u/2: together less than 1.2 u, with cos r > 0.707 less than 1.7 u cos r.
///
/// 2^-52 is 2 u. A compiler that fuses products and sums makes errors smaller. Tested against 400-bit arithmetic.
inline ProvenSine proven_sine(double a) {
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1, shift = 0x1.8p52;  // adding it rounds to the nearest integer
  constexpr double p1 = 0x1.921fb544p+0, p2 = 0x1.0b4611a6p-34, p3 = 0x1.3198a2e037073p-69;
  const double k = (a * two_over_pi + shift) - shift;
  // The exact sum of two numbers is their rounded sum and `lost` (Knuth, The Art of Computer Programming 2, 4.2.2).
  const auto sum = [](double x, double y, double& lost) {
    const double s = x + y, of_y = s - x;
    lost = (x - (s - of_y)) + (y - of_y);
    return s;
  };
  double lost = 0.0, low = 0.0;
  const double high = sum(a - k * p1, -(k * p2), lost);
  const double r = sum(high, lost - k * p3, low);
  const double t = r * r;
  double p = 1.0 / 355687428096000.0;  // 17!
  p = p * t - 1.0 / 1307674368000.0;
  p = p * t + 1.0 / 6227020800.0;
  p = p * t - 1.0 / 39916800.0;
  p = p * t + 1.0 / 362880.0;
  p = p * t - 1.0 / 5040.0;
  p = p * t + 1.0 / 120.0;
  p = p * t - 1.0 / 6.0;
  double q = -1.0 / 6402373705728000.0;  // 18!
  q = q * t + 1.0 / 20922789888000.0;
  q = q * t - 1.0 / 87178291200.0;
  q = q * t + 1.0 / 479001600.0;
  q = q * t - 1.0 / 3628800.0;
  q = q * t + 1.0 / 40320.0;
  q = q * t - 1.0 / 720.0;
  q = q * t + 1.0 / 24.0;
  const double cosine = 1.0 - (0.5 * t - (t * t * q - r * low));
  const double sine = r + (r * t * p + low * cosine);
  const double absolute = k == 0.0 ? 0.0 : 0x1p-98;
  switch (static_cast<std::int64_t>(k) & 3) {
    case 0:
      return {sine, cosine, absolute};
    case 1:
      return {cosine, -sine, absolute};
    case 2:
      return {-sine, -cosine, absolute};
    default:
      return {-cosine, sine, absolute};
  }
}

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
