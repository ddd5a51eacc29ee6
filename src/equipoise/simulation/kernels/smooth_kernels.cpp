// Kernels for smooth systems (BatchKind::smooth) and for driven rotors whose balls are held. Highway's foreach_target
// compiles this file once per CPU target.
#include "equipoise/simulation/kernels/batch_job.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/smooth_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/rule/clamped_balls-inl.hpp"
#include "equipoise/simulation/kernels/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

bool run_smooth_target(const BatchJob& job) { return run_job<BatchKind::smooth>(job); }

const auto held_rotors = [] {
  const auto make = [](const OwnRotor& own) { return HeldFlow<Pack>(own.system); };
  return OwnRotors<decltype(make)>{make};
}();

// One kernel for any number of balls: with the rotor they are one body.
bool run_clamped_target(const BatchTask& task, const ReleaseRule& rule, std::vector<ClampedEnd>& ends) {
  const auto watch = watch_of(task);
  const auto observer = std::make_unique<ClampedBalls>(task, rule, watch.get(), ends);
  return run_block<HeldFlow<Pack>, 1>(task, HeldFlow<Pack>(*task.system), *observer, held_rotors);
}

// To the task's end, without a rule.
bool advance_held_target(const BatchJob& job) {
  WatchForLoss fates(job.fates);
  return run_watched<HeldFlow<Pack>, 1>(job.task, HeldFlow<Pack>(*job.task.system), fates, held_rotors);
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(run_smooth_target);
HWY_EXPORT(run_clamped_target);
HWY_EXPORT(advance_held_target);

bool run_smooth_batch(const BatchJob& job) { return HWY_DYNAMIC_DISPATCH(run_smooth_target)(job); }

bool advance_held_batch(const BatchJob& job) { return HWY_DYNAMIC_DISPATCH(advance_held_target)(job); }

bool run_clamped_batch(const BatchTask& task, const ReleaseRule& rule, std::vector<ClampedEnd>& ends) {
  return HWY_DYNAMIC_DISPATCH(run_clamped_target)(task, rule, ends);
}

}  // namespace equipoise
#endif
