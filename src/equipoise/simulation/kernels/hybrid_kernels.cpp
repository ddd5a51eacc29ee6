// Kernels for systems with contact or dry friction (BatchKind::hybrid). Highway's foreach_target compiles this file
// once per CPU target.
#include "equipoise/simulation/kernels/batch_job.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/hybrid_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/kernels/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

bool run_hybrid_target(const BatchJob& job) { return run_job<BatchKind::hybrid>(job); }

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(run_hybrid_target);

bool run_hybrid_batch(const BatchJob& job) { return HWY_DYNAMIC_DISPATCH(run_hybrid_target)(job); }

}  // namespace equipoise
#endif
