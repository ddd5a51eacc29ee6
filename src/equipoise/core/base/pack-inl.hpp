// The number types of the equations: SIMD lanes (Pack), and the same functions for double.
//
// Included once per CPU target (see Highway's foreach_target), hence the unusual include guard. Everything lives in
// equipoise::HWY_NAMESPACE, so that code for one instruction set never links in place of another's.
//
// A number type T for the equations needs: + - * / and unary -, construction from double, and in its namespace (or in
// std) multiply_add, sin_cos, square_root, minimum, maximum, absolute. Pack and double are here; core/math/gradient.hpp
// adds numbers with derivatives.
#if defined(EQUIPOISE_BASE_PACK_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_BASE_PACK_INL
#undef EQUIPOISE_BASE_PACK_INL
#else
#define EQUIPOISE_BASE_PACK_INL
#endif

#include <cmath>
#include <cstddef>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// As many doubles as one register of this target holds, at most eight.
using PackTag = HWY_CAPPED(double, 8);
inline constexpr std::size_t pack_lanes = HWY_LANES(double) < 8 ? HWY_LANES(double) : 8;

// Portable code next to that for wider registers, which nearly every processor runs instead: compiled in fewer shapes,
// with the same results.
inline constexpr bool seldom_run = HWY_TARGET == HWY_SCALAR && HWY_TARGETS != HWY_SCALAR;

// What `{}` makes is zero, or false. Highway's vectors and masks of Arm have constructors of their own, which leave
// them as they are.
struct Mask {
#if HWY_ARCH_ARM && HWY_TARGET != HWY_SCALAR
  hn::Mask<PackTag> m = hn::MaskFromVec(hn::Zero(PackTag()));
#else
  hn::Mask<PackTag> m;
#endif
  friend HWY_INLINE Mask operator&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
  friend HWY_INLINE Mask operator|(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
};

struct Pack {
  hn::Vec<PackTag> v;

#if HWY_ARCH_ARM && HWY_TARGET != HWY_SCALAR
  HWY_INLINE Pack() : v(hn::Zero(PackTag())) {}
#else
  Pack() = default;
#endif
  HWY_INLINE Pack(double s) : v(hn::Set(PackTag(), s)) {}
  HWY_INLINE explicit Pack(hn::Vec<PackTag> w) : v(w) {}

  static HWY_INLINE Pack load(const double* p) { return Pack(hn::Load(PackTag(), p)); }
  HWY_INLINE void store(double* p) const { hn::Store(v, PackTag(), p); }

  friend HWY_INLINE Pack operator+(Pack a, Pack b) { return Pack(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Pack operator-(Pack a, Pack b) { return Pack(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE Pack operator*(Pack a, Pack b) { return Pack(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Pack operator/(Pack a, Pack b) { return Pack(hn::Div(a.v, b.v)); }
  friend HWY_INLINE Pack operator-(Pack a) { return Pack(hn::Neg(a.v)); }

  friend HWY_INLINE Mask operator<(Pack a, Pack b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE Mask operator<=(Pack a, Pack b) { return {hn::Le(a.v, b.v)}; }
};

// Result type of comparing two numbers of a type.
template <class T>
struct MaskOfType {
  using type = bool;
};
template <>
struct MaskOfType<Pack> {
  using type = Mask;
};
template <class T>
using MaskOf = typename MaskOfType<T>::type;

HWY_INLINE Pack multiply_add(Pack a, Pack b, Pack c) { return Pack(hn::MulAdd(a.v, b.v, c.v)); }
HWY_INLINE Pack negative_multiply_add(Pack a, Pack b, Pack c) { return Pack(hn::NegMulAdd(a.v, b.v, c.v)); }
HWY_INLINE Pack square_root(Pack a) { return Pack(hn::Sqrt(a.v)); }
HWY_INLINE Pack minimum(Pack a, Pack b) { return Pack(hn::Min(a.v, b.v)); }
HWY_INLINE Pack maximum(Pack a, Pack b) { return Pack(hn::Max(a.v, b.v)); }
HWY_INLINE Pack absolute(Pack a) { return Pack(hn::Abs(a.v)); }
HWY_INLINE Pack nearest_integer(Pack a) { return Pack(hn::Round(a.v)); }
HWY_INLINE Pack select(Mask m, Pack yes, Pack no) { return Pack(hn::IfThenElse(m.m, yes.v, no.v)); }
// base[index] in every lane; the indices are whole numbers >= 0.
HWY_INLINE Pack gather(const double* base, Pack index) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  return Pack(hn::GatherIndex(d, base, hn::ConvertTo(di, index.v)));
}
// The mask with these bits, one per lane.
HWY_INLINE Mask mask_of(unsigned bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
  return {hn::LoadMaskBits(PackTag(), bytes)};
}
HWY_INLINE bool any(Mask m) { return !hn::AllFalse(PackTag(), m.m); }

// One bit per lane.
HWY_INLINE unsigned lane_bits(Mask m) {
  alignas(64) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(PackTag(), m.m, bytes);
  return bytes[0];
}

// For |a| <= 1e8 absolute errors are below 6e-14, tested against the C library; beyond, results are meaningless. The
// nearest multiple k of pi is subtracted in parts, so that nothing is lost; both results get the sign (-1)^k. Minimax
// polynomials on [-pi/2, pi/2], from the Remez exchange, do the rest: sin to degree 13 (error 5.0e-14), cos to degree
// 14 (2.1e-15). Reducing by pi/2 would save a coefficient or two but cost an exchange of sin and cos.
HWY_INLINE void sin_cos(Pack a, Pack& sine, Pack& cosine) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  const Pack shift(0x1.8p52);  // adding it leaves k in the last digits
  const Pack shifted = multiply_add(a, Pack(0.31830988618379067154), shift);
  const Pack k = shifted - shift;
#if HWY_NATIVE_FMA
  Pack r = negative_multiply_add(k, Pack(0x1.921fb54442d18p+1), a);
  r = negative_multiply_add(k, Pack(0x1.1a62633145c07p-53), r);
#else  // parts short enough that their products with k are exact
  Pack r = negative_multiply_add(k, Pack(0x1.921fb54000000p+1), a);
  r = negative_multiply_add(k, Pack(0x1.10b4610000000p-29), r);
  r = negative_multiply_add(k, Pack(0x1.a62633145c06ep-57), r);
#endif
  const Pack t = r * r;
  Pack p(1.538743317568318e-10);
  p = multiply_add(p, t, Pack(-2.5028462354356365e-8));
  p = multiply_add(p, t, Pack(2.755690145426629e-6));
  p = multiply_add(p, t, Pack(-0.00019841266010920284));
  p = multiply_add(p, t, Pack(0.008333333316518188));
  p = multiply_add(p, t, Pack(-0.16666666666402324));
  const Pack s = multiply_add(r * t, p, r);
  Pack q(-1.1012491661645108e-11);
  q = multiply_add(q, t, Pack(2.0858735160546433e-9));
  q = multiply_add(q, t, Pack(-2.7556950754474657e-7));
  q = multiply_add(q, t, Pack(2.480158315633119e-5));
  q = multiply_add(q, t, Pack(-0.0013888888863934099));
  q = multiply_add(q, t, Pack(0.04166666666595421));
  q = multiply_add(q, t, Pack(-0.49999999999993117));
  const Pack c = multiply_add(q, t, Pack(1.0));
  const auto sign = hn::BitCast(d, hn::ShiftLeft<63>(hn::BitCast(di, shifted.v)));
  sine = Pack(hn::Xor(s.v, sign));
  cosine = Pack(hn::Xor(c.v, sign));
}

// One lane of a pack, then one lane of every pack in an aggregate.
HWY_INLINE double& element(Pack& a, int lane) { return reinterpret_cast<double*>(&a)[lane]; }
HWY_INLINE double element(const Pack& a, int lane) { return reinterpret_cast<const double*>(&a)[lane]; }
template <class Packs>
void take_lane(Packs& mine, const Packs& from, int lane) {
  static_assert(sizeof(Packs) % sizeof(Pack) == 0);
  for (std::size_t i = 0; i < sizeof(Packs) / sizeof(Pack); ++i)
    element(reinterpret_cast<Pack*>(&mine)[i], lane) = element(reinterpret_cast<const Pack*>(&from)[i], lane);
}
// The same for these members of an object.
template <class X, class... Members>
void take_lane_of(X& mine, const X& from, int lane, Members X::*... members) {
  (take_lane(mine.*members, from.*members, lane), ...);
}

HWY_INLINE double multiply_add(double a, double b, double c) { return a * b + c; }
HWY_INLINE double square_root(double a) { return std::sqrt(a); }
HWY_INLINE double minimum(double a, double b) { return b < a ? b : a; }
HWY_INLINE double maximum(double a, double b) { return a < b ? b : a; }
HWY_INLINE double absolute(double a) { return std::fabs(a); }
HWY_INLINE double select(bool m, double yes, double no) { return m ? yes : no; }
HWY_INLINE bool any(bool m) { return m; }
HWY_INLINE double nearest_integer(double a) { return std::nearbyint(a); }
HWY_INLINE double gather(const double* base, double index) { return base[static_cast<std::ptrdiff_t>(index)]; }
HWY_INLINE void sin_cos(double a, double& sine, double& cosine) {
  sine = std::sin(a);
  cosine = std::cos(a);
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
