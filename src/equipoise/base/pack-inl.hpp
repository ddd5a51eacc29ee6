// The number types of the equations: SIMD lanes (Pack), with the same small vocabulary for double.
//
// Included once per CPU target (see Highway's foreach_target), hence the unusual include guard. Everything lives in
// equipoise::HWY_NAMESPACE, so code for one instruction set can never be linked in place of another's.
//
// A number type T for the equations needs: + - * / and unary -, construction from double, and in its namespace (or in
// std) multiply_add, sin_cos, square_root, minimum, maximum, absolute. Pack and double are here; dual.hpp adds dual
// numbers.
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

struct Mask {
  hn::Mask<PackTag> m;
  friend HWY_INLINE Mask operator&(Mask a, Mask b) { return {hn::And(a.m, b.m)}; }
  friend HWY_INLINE Mask operator|(Mask a, Mask b) { return {hn::Or(a.m, b.m)}; }
};

struct Pack {
  hn::Vec<PackTag> v;

  HWY_INLINE Pack() = default;
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

HWY_INLINE Pack multiply_add(Pack a, Pack b, Pack c) { return Pack(hn::MulAdd(a.v, b.v, c.v)); }
HWY_INLINE Pack negative_multiply_add(Pack a, Pack b, Pack c) { return Pack(hn::NegMulAdd(a.v, b.v, c.v)); }
HWY_INLINE Pack square_root(Pack a) { return Pack(hn::Sqrt(a.v)); }
HWY_INLINE Pack minimum(Pack a, Pack b) { return Pack(hn::Min(a.v, b.v)); }
HWY_INLINE Pack maximum(Pack a, Pack b) { return Pack(hn::Max(a.v, b.v)); }
HWY_INLINE Pack absolute(Pack a) { return Pack(hn::Abs(a.v)); }
HWY_INLINE Pack nearest_integer(Pack a) { return Pack(hn::Round(a.v)); }
HWY_INLINE Pack select(Mask m, Pack yes, Pack no) { return Pack(hn::IfThenElse(m.m, yes.v, no.v)); }
// base[index] in every lane; index: whole numbers >= 0.
HWY_INLINE Pack gather(const double* base, Pack index) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  return Pack(hn::GatherIndex(d, base, hn::ConvertTo(di, index.v)));
}
HWY_INLINE bool any(Mask m) { return !hn::AllFalse(PackTag(), m.m); }

// One bit a lane.
HWY_INLINE unsigned lane_bits(Mask m) {
  alignas(64) std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(PackTag(), m.m, bytes);
  return bytes[0];
}

// sin and cos of every lane. |a| <= 2^26 pi/2 (1e8): relative error of sin and absolute error of cos below 6e-15, both
// tested against the C library with these numbers; outside, or for NaN and infinity, meaningless but finite time.
// Cody and Waite reduction by pi/2 in three parts (the products with k are exact), then minimax polynomials on
// [-pi/4, pi/4] found by the Remez exchange (sin to degree 11: 5.0e-15, cos to degree 12: 9.3e-17).
HWY_INLINE void sin_cos(Pack a, Pack& sine, Pack& cosine) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  const Pack k = nearest_integer(a * Pack(0.63661977236758134308));
  Pack r = negative_multiply_add(k, Pack(0x1.921fb54000000p+0), a);
  r = negative_multiply_add(k, Pack(0x1.10b4610000000p-30), r);
  r = negative_multiply_add(k, Pack(0x1.a62633145c06ep-58), r);
  const Pack t = r * r;
  Pack p(-2.4760396280364107863e-8);
  p = multiply_add(p, t, Pack(2.7555338863258828225e-6));
  p = multiply_add(p, t, Pack(-0.00019841263724953838152));
  p = multiply_add(p, t, Pack(0.0083333333250711354943));
  p = multiply_add(p, t, Pack(-0.16666666666630314194));
  const Pack s = multiply_add(r * t, p, r);
  Pack q(2.0645072383842568406e-9);
  q = multiply_add(q, t, Pack(-2.7555522386562056306e-7));
  q = multiply_add(q, t, Pack(0.000024801580703326767644));
  q = multiply_add(q, t, Pack(-0.0013888888877602661482));
  q = multiply_add(q, t, Pack(0.041666666666596467468));
  const Pack c = multiply_add(multiply_add(q, t, Pack(-0.5)), t, Pack(1.0));
  // The quadrant's number modulo four sits in the low bits of k + 1.5 2^52.
  const auto quadrant = hn::BitCast(di, hn::Add(k.v, hn::Set(d, 6755399441055744.0)));
  const auto odd = hn::MaskFromVec(hn::BitCast(d, hn::Neg(hn::And(quadrant, hn::Set(di, 1)))));
  const auto sign_of_sine = hn::BitCast(d, hn::ShiftLeft<62>(hn::And(quadrant, hn::Set(di, 2))));
  const auto sign_of_cosine =
      hn::BitCast(d, hn::ShiftLeft<62>(hn::And(hn::Add(quadrant, hn::Set(di, 1)), hn::Set(di, 2))));
  sine = Pack(hn::Xor(hn::IfThenElse(odd, c.v, s.v), sign_of_sine));
  cosine = Pack(hn::Xor(hn::IfThenElse(odd, s.v, c.v), sign_of_cosine));
}

HWY_INLINE double multiply_add(double a, double b, double c) { return a * b + c; }
HWY_INLINE double square_root(double a) { return std::sqrt(a); }
HWY_INLINE double minimum(double a, double b) { return b < a ? b : a; }
HWY_INLINE double maximum(double a, double b) { return a < b ? b : a; }
HWY_INLINE double absolute(double a) { return std::fabs(a); }
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
