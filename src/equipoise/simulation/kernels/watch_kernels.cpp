// The watches that kernels of all kinds may carry. Highway's foreach_target compiles this file once per CPU target.
#include "equipoise/simulation/batch/batch_task.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/simulation/kernels/watch_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/simulation/batch/watch_radius-inl.hpp"
#include "equipoise/simulation/transients/watch_transients-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

std::unique_ptr<BatchWatch> watch_of(const BatchTask& task) {
  const bool tilting = !task.held && task.kind() == BatchKind::tilting;  // held rotors stand upright
  if (task.transients && tilting) return std::make_unique<WatchTransients<true>>(task, *task.transients);
  if (task.transients) return std::make_unique<WatchTransients<false>>(task, *task.transients);
  if (task.radius) return std::make_unique<WatchRadius>(*task.radius);
  return nullptr;
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();
