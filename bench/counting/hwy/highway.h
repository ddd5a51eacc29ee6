// A stand-in for Highway that counts: the kernels' own headers, compiled against it, run on one lane and leave behind
// how many floating-point operations they took. Only what they use is here; the compiler says what else they come to.
#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#define HWY_NAMESPACE N_COUNTING
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_INLINE inline
#define HWY_NOINLINE inline
#define HWY_ATTR
#define HWY_TARGET 1  // the only one, and not portable code
#define HWY_TARGETS HWY_TARGET
#define HWY_SCALAR 2
#define HWY_CAPPED(T, N) hwy::N_COUNTING::Tag<T>
#define HWY_LANES(T) 1
#define HWY_NATIVE_FMA 1

namespace hwy::N_COUNTING {

/// Operations since somebody last cleared it. A fused multiply-add is two; comparisons, selections, signs, roundings
/// and whole numbers are none.
struct Operations {
  std::uint64_t add_or_multiply = 0, fused = 0, divide = 0, root = 0;
  std::uint64_t flops() const { return add_or_multiply + 2 * fused + divide + root; }
};
inline Operations operations;

template <class T>
struct Tag {
  using Lane = T;
};
template <class T>
struct Value {
  T v;
};
template <class D>
using Vec = Value<typename D::Lane>;
struct Flag {
  bool v;
};
template <class D>
using Mask = Flag;
template <class D>
using RebindToSigned = Tag<std::int64_t>;

using Real = Value<double>;

template <class T>
Value<T> Set(Tag<T>, T a) {
  return {a};
}
template <class T>
Value<T> Load(Tag<T>, const T* p) {
  return {*p};
}
template <class T>
void Store(Value<T> a, Tag<T>, T* p) {
  *p = a.v;
}

inline Real once(double a) {
  ++operations.add_or_multiply;
  return {a};
}
inline Real fused(double a) {
  ++operations.fused;
  return {a};
}
inline Real Add(Real a, Real b) { return once(a.v + b.v); }
inline Real Sub(Real a, Real b) { return once(a.v - b.v); }
inline Real Mul(Real a, Real b) { return once(a.v * b.v); }
inline Real MulAdd(Real a, Real b, Real c) { return fused(a.v * b.v + c.v); }
inline Real NegMulAdd(Real a, Real b, Real c) { return fused(c.v - a.v * b.v); }
inline Real MulSub(Real a, Real b, Real c) { return fused(a.v * b.v - c.v); }
inline Real NegMulSub(Real a, Real b, Real c) { return fused(-a.v * b.v - c.v); }
inline Real Div(Real a, Real b) {
  ++operations.divide;
  return {a.v / b.v};
}
inline Real Sqrt(Real a) {
  ++operations.root;
  return {std::sqrt(a.v)};
}

inline Real Neg(Real a) { return {-a.v}; }
inline Real Abs(Real a) { return {std::fabs(a.v)}; }
inline Real Min(Real a, Real b) { return {b.v < a.v ? b.v : a.v}; }
inline Real Max(Real a, Real b) { return {a.v < b.v ? b.v : a.v}; }
inline Real Round(Real a) { return {std::nearbyint(a.v)}; }
inline Flag Lt(Real a, Real b) { return {a.v < b.v}; }
inline Flag Le(Real a, Real b) { return {a.v <= b.v}; }
inline Flag And(Flag a, Flag b) { return {a.v && b.v}; }
inline Flag Or(Flag a, Flag b) { return {a.v || b.v}; }
inline Real IfThenElse(Flag m, Real yes, Real no) { return m.v ? yes : no; }
template <class T>
bool AllFalse(Tag<T>, Flag m) {
  return !m.v;
}
template <class T>
void StoreMaskBits(Tag<T>, Flag m, std::uint8_t* bits) {
  *bits = m.v;
}
template <class T>
Flag LoadMaskBits(Tag<T>, const std::uint8_t* bits) {
  return {(*bits & 1) != 0};
}
template <class T>
Flag MaskFromVec(Value<T> a) {
  return {std::bit_cast<std::int64_t>(a.v) < 0};
}

// Whole numbers and bits.
using Whole = Value<std::int64_t>;
inline Whole Set(Tag<std::int64_t>, int a) { return {a}; }
inline Whole Add(Whole a, Whole b) { return {a.v + b.v}; }
inline Whole Sub(Whole a, Whole b) { return {a.v - b.v}; }
inline Whole Neg(Whole a) { return {-a.v}; }
inline Whole And(Whole a, Whole b) { return {a.v & b.v}; }
inline Whole Or(Whole a, Whole b) { return {a.v | b.v}; }
template <int bits>
Whole ShiftLeft(Whole a) {
  return {static_cast<std::int64_t>(static_cast<std::uint64_t>(a.v) << bits)};
}
template <int bits>
Whole ShiftRight(Whole a) {
  return {a.v >> bits};
}
template <class T, class U>
Value<T> BitCast(Tag<T>, Value<U> a) {
  return {std::bit_cast<T>(a.v)};
}
template <class T, class U>
Value<T> ConvertTo(Tag<T>, Value<U> a) {
  return {static_cast<T>(a.v)};
}
template <class T>
Value<T> Xor(Value<T> a, Value<T> b) {
  return {std::bit_cast<T>(std::bit_cast<std::int64_t>(a.v) ^ std::bit_cast<std::int64_t>(b.v))};
}
inline Real And(Real a, Real b) {
  return {std::bit_cast<double>(std::bit_cast<std::int64_t>(a.v) & std::bit_cast<std::int64_t>(b.v))};
}
inline Real GatherIndex(Tag<double>, const double* base, Whole index) { return {base[index.v]}; }

}  // namespace hwy::N_COUNTING
