// Tangent vectors for every CPU target: compiled once per instruction set by Highway's foreach_target. No product is
// fused with a sum, so that all targets agree.
#include "equipoise/attractors/periodic_orbits/variational.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "equipoise/attractors/periodic_orbits/tangent_kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "equipoise/attractors/periodic_orbits/tangent_flow-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Most machines have two balls.
template <template <int room> class Source>
std::optional<TangentFlight> follow_plain(const model::System& system, const auto&... rest) {
  using model::dimension;
  if (system.balls() == 2) return follow<Source<2>, dimension(2)>(system, rest...);
  return follow<Source<model::any_count>, dimension(4), dimension(8), dimension(16)>(system, rest...);
}

std::optional<TangentFlight> follow_target(const model::System& system, const Eigen::VectorXd& state,
                                           const Eigen::MatrixXd& vectors, double duration, double tolerance,
                                           double psi, const StopFlag* stop) {
  using G = GeneralSource;
  using T = TiltSource;
  if (system.tilts())
    return follow<T, T::largest<4>, T::largest<16>>(system, state, vectors, duration, tolerance, psi, stop);
  if (!system.plain())
    return follow<G, G::largest<2>, G::largest<4>, G::largest<8>, G::largest<16>>(system, state, vectors, duration,
                                                                                  tolerance, psi, stop);
  return system.autonomous() ? follow_plain<Autonomous>(system, state, vectors, duration, tolerance, psi, stop)
                             : follow_plain<AngleDependent>(system, state, vectors, duration, tolerance, psi, stop);
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace equipoise {

HWY_EXPORT(follow_target);

std::optional<TangentFlight> follow_tangents(const model::System& system, const Eigen::VectorXd& state,
                                             const Eigen::MatrixXd& vectors, double duration, double tolerance,
                                             double psi, const StopFlag* stop) {
  return HWY_DYNAMIC_DISPATCH(follow_target)(system, state, vectors, duration, tolerance, psi, stop);
}

}  // namespace equipoise
#endif
