// Portable code of every kind of kernel, where nearly every processor runs code for wider registers instead: compiled once,
// with fewer optimisations and the same results.
#include "hwy/highway.h"

#include "equipoise/kernels/kernel-inl.hpp"

#if HWY_TARGET == HWY_SCALAR && HWY_TARGETS != HWY_SCALAR
HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template bool run_job<BatchKind::plain>(const BatchJob& job);
template bool run_job<BatchKind::turning>(const BatchJob& job);
template bool run_job<BatchKind::smooth>(const BatchJob& job);
template bool run_job<BatchKind::hybrid>(const BatchJob& job);
template bool run_job<BatchKind::tilting>(const BatchJob& job);

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();
#endif
