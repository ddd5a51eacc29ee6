// Tangent vectors for every CPU target: compiled once per instruction set by Highway's foreach_target. No product is
// fused with a sum, so that all targets agree.
#include "equipoise/attractors/periodic_orbits/tangent_kernels.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/attractors/periodic_orbits/tangent_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <class Source, int... widths>
std::optional<TangentFlight> run_source(const TangentJob& j) {
  if constexpr (seldom_run)
    return follow<Source, Source::dimension>(j.system, j.state, j.vectors, j.duration, j.tolerance, j.psi, j.stop);
  else
    return follow<Source, widths...>(j.system, j.state, j.vectors, j.duration, j.tolerance, j.psi, j.stop);
}

// Most machines have two balls.
template <template <int room> class Source>
std::optional<TangentFlight> run_plain(const TangentJob& j) {
  using model::dimension;
  if (j.system.balls() == 2) return run_source<Source<2>, dimension(2)>(j);
  return run_source<Source<model::any_count>, dimension(4), dimension(8), dimension(16)>(j);
}

std::optional<TangentFlight> run_tangents_target(const TangentJob& j) {
  using G = GeneralSource;
  using T = TiltSource;
  if (j.system.tilts()) return run_source<T, T::largest<4>, T::largest<16>>(j);
  if (!j.system.plain()) return run_source<G, G::largest<2>, G::largest<4>, G::largest<8>, G::largest<16>>(j);
  return j.system.autonomous() ? run_plain<Autonomous>(j) : run_plain<AngleDependent>(j);
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(run_tangents_target);

std::optional<TangentFlight> run_tangents(const TangentJob& job) {
  return HWY_DYNAMIC_DISPATCH(run_tangents_target)(job);
}

}  // namespace equipoise
#endif
