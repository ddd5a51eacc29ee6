// Affine arithmetic: a function on a small box as a linear function plus a rigorous bound on what that leaves out.
//
// centre + sum_k slope_k t_k, all t_k in [-1, 1], is within `radius` of the exact value everywhere on the box. The
// remainder of every operation is of second order in the box's size, where an interval's is of first order: far fewer
// boxes prove the same. A number type of the equations (see pack-inl.hpp for what that asks); as for interval.hpp, it
// needs round-to-nearest and no -ffast-math. Method: Comba and Stolfi, "Affine arithmetic and its applications to
// computer graphics", SIBGRAPI (1993), here with the box's own variables as the only symbols.
//
// Rounding: each radius adds 2u = 2^-52 (`unit`) times the magnitudes that were rounded; `grown` outweighs the rounding
// of the radius itself, a sum of at most a dozen non-negative terms, and `least` outweighs underflow.
#pragma once

#include <cmath>

#include "equipoise/core/math/interval.hpp"

namespace equipoise {

/// A number known up to `error`.
struct Constant {
  double value = 0.0, error = 0.0;

  Constant() = default;
  Constant(double v, double e = 0.0) : value(v), error(e) {}
  explicit Constant(const Interval& a) : value(a.middle()), error(a.radius()) {}
};

template <int n>
struct AffineForm {
  static constexpr double unit = 0x1p-52, grown = 1.0 + 0x1p-48, least = 0x1p-1000;

  double centre = 0.0, slope[n] = {}, radius = 0.0;

  AffineForm() = default;
  AffineForm(double v) : centre(v) {}
  explicit AffineForm(const Constant& v) : centre(v.value), radius(v.error) {}

  /// Sum of the slopes' magnitudes, rounded.
  double swing() const {
    double sum = 0.0;
    for (int k = 0; k < n; ++k) sum += std::fabs(slope[k]);
    return sum;
  }
  /// Bound on the distance of any value from the centre.
  double reach() const { return grown * (swing() + radius) + least; }

  friend AffineForm operator+(const AffineForm& a, const AffineForm& b) {
    AffineForm r;
    r.centre = a.centre + b.centre;
    for (int k = 0; k < n; ++k) r.slope[k] = a.slope[k] + b.slope[k];
    r.radius = grown * (a.radius + b.radius + unit * (std::fabs(r.centre) + r.swing())) + least;
    return r;
  }
  friend AffineForm operator-(const AffineForm& a) {
    AffineForm r;
    r.centre = -a.centre;
    for (int k = 0; k < n; ++k) r.slope[k] = -a.slope[k];
    r.radius = a.radius;
    return r;
  }
  friend AffineForm operator-(const AffineForm& a, const AffineForm& b) { return a + (-b); }

  friend AffineForm operator*(const AffineForm& a, const Constant& b) {
    AffineForm r;
    const double size = std::fabs(b.value);
    r.centre = a.centre * b.value;
    for (int k = 0; k < n; ++k) r.slope[k] = a.slope[k] * b.value;
    const double magnitude = std::fabs(a.centre) + a.swing();
    r.radius = grown * (a.radius * (size + b.error) + magnitude * (b.error + unit * size)) + least;
    return r;
  }

  /// Products t_k t_k lie in [0, 1] and are split at 1/2; products of different symbols only bounded.
  friend AffineForm operator*(const AffineForm& a, const AffineForm& b) {
    AffineForm r;
    double even = 0.0, bend = 0.0;
    for (int k = 0; k < n; ++k) {
      even += 0.5 * a.slope[k] * b.slope[k];
      bend += 0.5 * std::fabs(a.slope[k] * b.slope[k]);
      for (int j = 0; j < k; ++j) bend += std::fabs(a.slope[k] * b.slope[j] + a.slope[j] * b.slope[k]);
    }
    const double sa = a.swing(), sb = b.swing(), ca = std::fabs(a.centre), cb = std::fabs(b.centre);
    r.centre = a.centre * b.centre + even;
    for (int k = 0; k < n; ++k) r.slope[k] = a.centre * b.slope[k] + b.centre * a.slope[k];
    r.radius = grown * (bend + (ca + sa) * b.radius + (cb + sb + b.radius) * a.radius +
                        unit * 2.0 * (ca * cb + ca * sb + cb * sa + sa * sb)) +
               least;
    return r;
  }

  /// 1/(c (1 + z)) = (1 - z + z^2 - z^3/(1 + z)) / c with z = (b - c)/c.
  friend AffineForm operator/(const AffineForm& a, const AffineForm& b) {
    AffineForm offset = b;
    offset.centre = 0.0;
    const Interval inverse = Interval(1.0) / Interval(b.centre);
    const AffineForm z = offset * Constant(inverse);
    const Interval bound(z.reach());
    const Interval tail = bound * bound * bound / (Interval(1.0) - bound);
    AffineForm series = AffineForm(1.0) - z + z * z;
    // A divisor that may vanish leaves a remainder without bound, and thus nothing proved.
    series.radius = bound.high < 1.0 ? grown * (series.radius + tail.high) : Interval::whole().high;
    return a * (series * Constant(inverse));
  }
};

/// Taylor's formula about the centre, to second order with Lagrange's bound on the third.
template <int n>
void sin_cos(const AffineForm<n>& a, AffineForm<n>& sine, AffineForm<n>& cosine) {
  Interval s, c;
  sin_cos_of_number(a.centre, s, c);
  AffineForm<n> offset = a;
  offset.centre = 0.0;
  const Interval reach(offset.reach());
  const double tail = (reach * reach * reach / Interval(6.0)).high;
  const AffineForm<n> half_square = offset * offset * Constant(0.5);
  const Constant at_sine(s), at_cosine(c);
  sine = AffineForm<n>(at_sine) + offset * at_cosine - half_square * at_sine;
  cosine = AffineForm<n>(at_cosine) - offset * at_sine - half_square * at_cosine;
  sine.radius = rounded_up(sine.radius + tail);
  cosine.radius = rounded_up(cosine.radius + tail);
}

}  // namespace equipoise
