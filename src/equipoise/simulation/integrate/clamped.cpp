// Integration of the clamped basis over the spin-up's segments, and of one body up to its release.
#include "equipoise/simulation/integrate/clamped.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/first_time.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
}

void ClampedBasis::centre(const model::Parameters& p, const double* phi, double* xyuv) const {
  const std::complex<double> unbalance = model::unbalance(p, phi);
  for (int j = 0; j < 4; ++j) xyuv[j] = values[j] + unbalance.real() * values[4 + j] + unbalance.imag() * values[8 + j];
}

IntegrationStatus integrate_clamped(const model::Parameters& p, const std::vector<model::Segment>& segments,
                                    const std::array<double, 4>& initial, double tolerance, ClampedBasis& basis,
                                    const std::vector<double>& times, const ClampedObserver& observe, double until,
                                    const StopFlag* stop) {
  basis = {};
  for (int j = 0; j < 4; ++j) basis.values[j] = initial[j];
  kernels::ErrorScale<kernels::ClampedBasisFlow::dimension> scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1e-3);  // a displacement this small, per unit of unbalance, needs no more relative accuracy

  std::size_t next = 0;
  for (std::size_t k = 0; k < segments.size() && segments[k].clamped; ++k) {
    const model::Segment& segment = segments[k];
    if (is_set(stop)) return IntegrationStatus::done;
    for (; next < times.size() && times[next] == segment.begin; ++next) observe(segment.begin, segment, basis);
    const double end = std::min(segment.end, until);
    if (!(segment.begin < end)) return IntegrationStatus::done;
    const kernels::ClampedBasisFlow flow(p, segment);
    kernels::AdaptiveIntegrator<kernels::ClampedBasisFlow, kernels::ClampedBasisFlow::dimension> integrator(flow,
                                                                                                            scale);
    const IntegrationStatus status = integrator.advance(
        segment.begin, end, basis.values.data(),
        [&](double, double t_new, auto&& state_at) {
          for (; next < times.size() && times[next] <= t_new && times[next] < segment.end; ++next) {
            ClampedBasis at;
            state_at(times[next], at.values.data());
            observe(times[next], segment, at);
          }
        },
        stop);
    if (status != IntegrationStatus::done) return status;
    const double jump = segments[k + 1].speed - segment.speed_at(segment.end);
    for (int solution = 0; solution < 3; ++solution) model::apply_speed_jump(jump, basis.values.data() + 4 * solution);
  }
  return IntegrationStatus::done;
}

std::optional<double> find_release(const model::System& system, double speed, bool rising, double from, double to,
                                   double* state) {
  using Flow = kernels::HeldFlow<double>;
  const int place = model::held_layout(system).speed;
  const auto come = [&](const double* y) { return rising ? y[place] >= speed : y[place] <= speed; };
  kernels::ErrorScale<Flow::dimension> scale;
  scale.tolerance = 1e-10;  // only a step or two are taken, so a tight one costs nothing
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = system.parameters().motion_scale();
  scale.angle.fill(true);  // lanes detect divergence
  scale.absolute.fill(true);
  const Flow flow(system);
  kernels::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, flow.size());
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
