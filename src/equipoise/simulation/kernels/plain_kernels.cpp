// Kernels for rotors whose equations do not depend on the rotor's angle (BatchKind::plain). Highway's foreach_target
// compiles this file once per CPU target.
#include "equipoise/simulation/kernels/batch_job.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/plain_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/kernels/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

bool run_plain_target(const BatchJob& job) { return run_job<BatchKind::plain>(job); }

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(run_plain_target);

bool run_plain_batch(const BatchJob& job) { return HWY_DYNAMIC_DISPATCH(run_plain_target)(job); }

}  // namespace equipoise
#endif
