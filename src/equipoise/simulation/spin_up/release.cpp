// Follows a double-precision trajectory; halves its dense output until the crossing is found.
#include "equipoise/simulation/spin_up/release.hpp"

#include <cmath>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/first_time.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

using Flow = kernels::HeldFlow<double>;

// Only a step or two are taken, so a tight tolerance costs nothing.
constexpr double tolerance = 1e-10;

kernels::ErrorScale<Flow::dimension> scale_of(const model::System& system) {
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = system.parameters().motion_scale();
  scale.angle.fill(true);  // lanes detect divergence
  scale.absolute.fill(true);
  return scale;
}

}  // namespace

std::optional<double> find_release(const model::System& system, const ReleaseRule& rule, double from, double to,
                                   double* state) {
  const int place = model::held_layout(system).speed;
  const auto come = [&](const double* y) {
    return rule.rising ? y[place] >= rule.release_speed : y[place] <= rule.release_speed;
  };
  const Flow flow(system);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale_of(system), flow.size());
  std::optional<double> found;
  const auto look = [&](double begin, double end, auto&& state_at) {
    double y[Flow::dimension];
    const auto first = first_time(begin, end, [&](double t) {
      state_at(t, y);
      return come(y);
    });
    if (!first) return end;
    found = first;  // the step is cut here, and the crossing is looked up again
    // The integrator stops only at times before the step's end.
    return std::fmin(*first, std::nextafter(end, begin));
  };
  integrator.advance(from, to, state, look);
  return found;
}

}  // namespace equipoise
