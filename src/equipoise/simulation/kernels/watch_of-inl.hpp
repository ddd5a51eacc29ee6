// The watch that a task asks for, compiled once for the kernels of all kinds (watch_kernels.cpp). Included once per CPU
// target.
#if defined(EQUIPOISE_KERNELS_WATCH_OF_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_KERNELS_WATCH_OF_INL
#undef EQUIPOISE_KERNELS_WATCH_OF_INL
#else
#define EQUIPOISE_KERNELS_WATCH_OF_INL
#endif

#include <memory>

#include "equipoise/simulation/batch/batch_watch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

std::unique_ptr<BatchWatch> watch_of(const BatchTask& task);  // null if none

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
