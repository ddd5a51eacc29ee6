// Dual numbers (core/math/gradient.hpp over double) with their slopes side by side in registers. Without fused products
// and sums, results are bit-identical. Included once per CPU target.
#if defined(EQUIPOISE_MATH_WIDE_DUAL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MATH_WIDE_DUAL_INL
#undef EQUIPOISE_MATH_WIDE_DUAL_INL
#else
#define EQUIPOISE_MATH_WIDE_DUAL_INL
#endif

#include <cmath>
#include <cstring>

#include "equipoise/core/base/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A number type of the equations.
template <int slopes>
class WideDual {
 public:
  double value = 0.0;

  WideDual() = default;
  HWY_INLINE WideDual(double v) : value(v) {}

  // Takes the first `count` slopes; the others are 0.
  HWY_INLINE void take_slopes(const double* from, int count) {
    alignas(Pack) double all[room] = {};
    std::memcpy(all, from, sizeof(double) * static_cast<std::size_t>(count));
    for (int k = 0; k < packs; ++k) slope_[k] = Pack::load(all + k * lanes);
  }
  HWY_INLINE void put_slopes(double* to, int count) const {
    alignas(Pack) double all[room];
    for (int k = 0; k < packs; ++k) slope_[k].store(all + k * lanes);
    std::memcpy(to, all, sizeof(double) * static_cast<std::size_t>(count));
  }

  friend HWY_INLINE WideDual operator+(const WideDual& a, const WideDual& b) {
    return combine(a.value + b.value, [&](int k) HWY_ATTR { return a.slope_[k] + b.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator-(const WideDual& a, const WideDual& b) {
    return combine(a.value - b.value, [&](int k) HWY_ATTR { return a.slope_[k] - b.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator-(const WideDual& a) {
    return combine(-a.value, [&](int k) HWY_ATTR { return -a.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator*(const WideDual& a, const WideDual& b) {
    const Pack of_a(a.value), of_b(b.value);
    return combine(a.value * b.value, [&](int k) HWY_ATTR { return a.slope_[k] * of_b + of_a * b.slope_[k]; });
  }
  friend HWY_INLINE WideDual operator/(const WideDual& a, const WideDual& b) {
    const double quotient = a.value / b.value;
    const Pack inverse(1.0 / b.value), whole(quotient);
    return combine(quotient, [&](int k) HWY_ATTR { return (a.slope_[k] - whole * b.slope_[k]) * inverse; });
  }
  friend HWY_INLINE WideDual multiply_add(const WideDual& a, const WideDual& b, const WideDual& c) { return a * b + c; }
  friend HWY_INLINE void sin_cos(const WideDual& a, WideDual& sine, WideDual& cosine) {
    const double s = std::sin(a.value), c = std::cos(a.value);
    const WideDual from = a;  // `a` may be one of the results
    const Pack along(c), back(-s);
    sine = combine(s, [&](int k) HWY_ATTR { return along * from.slope_[k]; });
    cosine = combine(c, [&](int k) HWY_ATTR { return back * from.slope_[k]; });
  }

 private:
  static constexpr int lanes = static_cast<int>(pack_lanes), packs = (slopes + lanes - 1) / lanes, room = packs * lanes;

  template <class Slope>
  static HWY_INLINE WideDual combine(double value, Slope&& slope_at) {
    WideDual result(value);
    for (int k = 0; k < packs; ++k) result.slope_[k] = slope_at(k);
    return result;
  }

  Pack slope_[packs] = {};
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
