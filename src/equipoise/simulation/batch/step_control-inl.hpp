// Step sizes per lane: a proportional-integral controller on the logarithm of the error. Included once per CPU target.
#if defined(EQUIPOISE_BATCH_STEP_CONTROL_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_BATCH_STEP_CONTROL_INL
#undef EQUIPOISE_BATCH_STEP_CONTROL_INL
#else
#define EQUIPOISE_BATCH_STEP_CONTROL_INL
#endif

#include "equipoise/core/base/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// log2 of a positive normal number, linear in the mantissa: exact at powers of two, up to 0.0861 too small between.
// Accurate enough for a step size (a tenth of it enters an exponent), at a few integer operations on every target.
HWY_INLINE Pack coarse_log2(Pack a) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  return Pack(hn::ConvertTo(d, hn::BitCast(di, a.v))) * Pack(0x1p-52) - Pack(1023.0);
}

// The inverse of coarse_log2: exact at whole numbers, up to 6.2 % too large between.
HWY_INLINE Pack coarse_exp2(Pack a) {
  const PackTag d;
  const hn::RebindToSigned<PackTag> di;
  return Pack(hn::BitCast(d, hn::ConvertTo(di, ((a + Pack(1023.0)) * Pack(0x1p52)).v)));
}

struct StepChange {
  Pack factor;     // next step over this one
  Pack log_error;  // to keep if the step is accepted
};

// `error2`: square of the error norm of this step; `log_error`: of the last accepted step. Exponents in units of 1/8
// (the order of the estimate): proportional 0.4, integral 0.4; safety factor 0.9; bounds 0.2 and 6. A rejected step,
// error2 > 1, is judged by its own error alone.
HWY_INLINE StepChange step_change(Pack error2, Pack log_error) {
  const Mask usable = error2 < Pack(1e60);  // false for not-a-number
  const Pack bounded = maximum(select(usable, error2, Pack(1e60)), Pack(1e-12));
  const Pack log2_error = Pack(0.5) * coarse_log2(bounded);
  const Pack log2_safety(-0.152);
  const Pack smooth = multiply_add(Pack(-0.8 / 8), log2_error, multiply_add(Pack(0.4 / 8), log_error, log2_safety));
  const Pack direct = multiply_add(Pack(-1.0 / 8), log2_error, log2_safety);
  const Pack exponent = select(error2 <= Pack(1.0), smooth, direct);
  return {coarse_exp2(minimum(maximum(exponent, Pack(-2.32)), Pack(2.58))), log2_error};
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
