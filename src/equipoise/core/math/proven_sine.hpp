// Sine and cosine with an error that is proved here, for proofs: no word of a C library is taken for it, and all
// systems get the same bits.
#pragma once

#include <cmath>
#include <cstdint>

namespace equipoise {

/// Sine and cosine of one double. Each differs from the exact value by at most 2^-52 of its own size, plus `absolute`.
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

}  // namespace equipoise
