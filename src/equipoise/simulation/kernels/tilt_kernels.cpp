// Kernels for rotors that tilt (BatchKind::tilting). Highway's foreach_target compiles this file
// once per CPU target.
#include "equipoise/simulation/kernels/batch_job.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/tilt_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/kernels/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Two planes of two balls, which most such rotors have, unrolled: a sixth faster. One kernel serves all other counts.
bool run_tilting_target(const BatchJob& job) {
  constexpr BatchKind kind = BatchKind::tilting;
  if constexpr (!seldom_run)
    if (job.task.parameters->balls == 4) return job.rule ? classify_balls<4, kind>(job) : advance_balls<4, kind>(job);
  return run_job<kind>(job);
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(run_tilting_target);

bool run_tilting_batch(const BatchJob& job) { return HWY_DYNAMIC_DISPATCH(run_tilting_target)(job); }

}  // namespace equipoise
#endif
