// A stand-in for Highway on WebAssembly, whose own has no doubles there: two lanes of f64x2. Only what kernels use is
// here. Results are those of Highway's SSE4, to the bit: there is no fused multiply-add.
#pragma once

#include <wasm_simd128.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#define HWY_WASM_DOUBLES 1
#define HWY_SCALAR 2
#define HWY_AVX3 3
#define HWY_TARGET HWY_WASM_DOUBLES
#define HWY_TARGETS HWY_TARGET
#define HWY_NAMESPACE N_WASM_DOUBLES
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_INLINE inline __attribute__((always_inline))
#define HWY_NOINLINE __attribute__((noinline))
#define HWY_ATTR
#define HWY_LIKELY(x) __builtin_expect(!!(x), 1)
#define HWY_UNLIKELY(x) __builtin_expect(!!(x), 0)
#define HWY_CAPPED(T, N) hwy::HWY_NAMESPACE::Tag<T>
#define HWY_LANES(T) 2
#define HWY_NATIVE_FMA 0
// One target: whatever is dispatched is bound when it is compiled.
#define HWY_ONCE 1
#define HWY_EXPORT(f) static_assert(true)
#define HWY_DYNAMIC_DISPATCH(f) HWY_NAMESPACE::f

namespace hwy {

inline const char* TargetName(std::int64_t) { return "WebAssembly"; }
inline std::vector<std::int64_t> SupportedAndGeneratedTargets() { return {HWY_TARGET}; }
inline void SetSupportedTargetsForTest(std::int64_t) {}
struct ChosenTarget {
  void DeInit() {}
};
inline ChosenTarget GetChosenTarget() { return {}; }

namespace HWY_NAMESPACE {

template <class T>
struct Tag {
  using Lane = T;
};
template <class T>
struct Value {
  v128_t v;
};
template <class D>
using Vec = Value<typename D::Lane>;
struct Flags {
  v128_t v;
};
template <class D>
using Mask = Flags;
template <class D>
using RebindToSigned = Tag<std::int64_t>;

using Reals = Value<double>;
using Wholes = Value<std::int64_t>;

HWY_INLINE Reals Set(Tag<double>, double a) { return {wasm_f64x2_splat(a)}; }
HWY_INLINE Reals Load(Tag<double>, const double* p) { return {wasm_v128_load(p)}; }
HWY_INLINE void Store(Reals a, Tag<double>, double* p) { wasm_v128_store(p, a.v); }

HWY_INLINE Reals Add(Reals a, Reals b) { return {wasm_f64x2_add(a.v, b.v)}; }
HWY_INLINE Reals Sub(Reals a, Reals b) { return {wasm_f64x2_sub(a.v, b.v)}; }
HWY_INLINE Reals Mul(Reals a, Reals b) { return {wasm_f64x2_mul(a.v, b.v)}; }
HWY_INLINE Reals Div(Reals a, Reals b) { return {wasm_f64x2_div(a.v, b.v)}; }
HWY_INLINE Reals MulAdd(Reals a, Reals b, Reals c) { return Add(Mul(a, b), c); }
HWY_INLINE Reals NegMulAdd(Reals a, Reals b, Reals c) { return Sub(c, Mul(a, b)); }
HWY_INLINE Reals Sqrt(Reals a) { return {wasm_f64x2_sqrt(a.v)}; }
HWY_INLINE Reals Neg(Reals a) { return {wasm_f64x2_neg(a.v)}; }
HWY_INLINE Reals Abs(Reals a) { return {wasm_f64x2_abs(a.v)}; }
// The second where one is not a number, as SSE has it: the pseudo-minimum with its operands exchanged.
HWY_INLINE Reals Min(Reals a, Reals b) { return {wasm_f64x2_pmin(b.v, a.v)}; }
HWY_INLINE Reals Max(Reals a, Reals b) { return {wasm_f64x2_pmax(b.v, a.v)}; }
HWY_INLINE Reals Round(Reals a) { return {wasm_f64x2_nearest(a.v)}; }

HWY_INLINE Flags Lt(Reals a, Reals b) { return {wasm_f64x2_lt(a.v, b.v)}; }
HWY_INLINE Flags Le(Reals a, Reals b) { return {wasm_f64x2_le(a.v, b.v)}; }
HWY_INLINE Flags And(Flags a, Flags b) { return {wasm_v128_and(a.v, b.v)}; }
HWY_INLINE Flags Or(Flags a, Flags b) { return {wasm_v128_or(a.v, b.v)}; }
HWY_INLINE Reals IfThenElse(Flags m, Reals yes, Reals no) { return {wasm_v128_bitselect(yes.v, no.v, m.v)}; }
HWY_INLINE bool AllFalse(Tag<double>, Flags m) { return !wasm_v128_any_true(m.v); }
HWY_INLINE void StoreMaskBits(Tag<double>, Flags m, std::uint8_t* bits) {
  *bits = static_cast<std::uint8_t>(wasm_i64x2_bitmask(m.v));
}
HWY_INLINE Flags LoadMaskBits(Tag<double>, const std::uint8_t* bits) {
  return {wasm_i64x2_make(-static_cast<std::int64_t>(*bits & 1), -static_cast<std::int64_t>(*bits >> 1 & 1))};
}

template <class T, class U>
HWY_INLINE Value<T> BitCast(Tag<T>, Value<U> a) {
  return {a.v};
}
HWY_INLINE Reals ConvertTo(Tag<double>, Wholes a) {
  return {wasm_f64x2_make(static_cast<double>(wasm_i64x2_extract_lane(a.v, 0)),
                          static_cast<double>(wasm_i64x2_extract_lane(a.v, 1)))};
}
// Of numbers that have a whole one.
HWY_INLINE Wholes ConvertTo(Tag<std::int64_t>, Reals a) {
  return {wasm_i64x2_make(static_cast<std::int64_t>(wasm_f64x2_extract_lane(a.v, 0)),
                          static_cast<std::int64_t>(wasm_f64x2_extract_lane(a.v, 1)))};
}
template <int bits>
HWY_INLINE Wholes ShiftLeft(Wholes a) {
  return {wasm_i64x2_shl(a.v, bits)};
}
HWY_INLINE Reals Xor(Reals a, Reals b) { return {wasm_v128_xor(a.v, b.v)}; }
HWY_INLINE Reals GatherIndex(Tag<double>, const double* base, Wholes index) {
  return {wasm_f64x2_make(base[wasm_i64x2_extract_lane(index.v, 0)], base[wasm_i64x2_extract_lane(index.v, 1)])};
}

}  // namespace HWY_NAMESPACE
}  // namespace hwy
