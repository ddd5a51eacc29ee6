// Dense output of a double precision trajectory, halved until the crossing is found.
#include "equipoise/spin_up/release.hpp"

#include <cmath>

#include "equipoise/integrate/adaptive-inl.hpp"
#include "equipoise/lanes/held_state.hpp"
#include "equipoise/lanes/lane_task.hpp"
#include "equipoise/model/smooth_flow-inl.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;

using Flow = kernels::HeldFlow<double>;

// A step or two of what took thousands: tight costs nothing.
constexpr double tolerance = 1e-10;

kernels::ErrorScale<Flow::dimension> scale_of(const model::System& system) {
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = system.parameters().all_unbalances();
  scale.angle.fill(true);  // what diverges is told by lanes
  scale.absolute.fill(true);
  return scale;
}

}  // namespace

std::optional<double> find_release(const model::System& system, const HoldRule& rule, double from, double to,
                                   double* state) {
  const int place = system.speed_place() + model::dimension(1) - model::dimension(system.balls());
  const auto come = [&](const double* y) {
    return rule.rising ? y[place] >= rule.release_speed : y[place] <= rule.release_speed;
  };
  const Flow flow(system);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale_of(system), flow.size());
  std::optional<double> found;
  const auto look = [&](double begin, double end, auto&& state_at) {
    constexpr int looks = 4;
    double y[Flow::dimension], low = begin;
    for (int k = 1; k <= looks; ++k) {
      double high = k == looks ? end : begin + (end - begin) * k / looks;
      state_at(high, y);
      if (!come(y)) {
        low = high;
        continue;
      }
      for (;;) {
        const double middle = 0.5 * (low + high);
        if (!(low < middle && middle < high)) break;
        state_at(middle, y);
        (come(y) ? high : low) = middle;
      }
      found = high;
      // Before the step's end, even if by nothing that matters, is where the integrator stops.
      return std::fmin(high, std::nextafter(end, begin));
    }
    return end;
  };
  integrator.advance(from, to, state, look);
  return found;
}

}  // namespace equipoise
