// Integration of the clamped basis over the spin-up's segments.
#include "equipoise/simulation/integrate/clamped.hpp"

#include <algorithm>
#include <cstddef>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/model/flow-inl.hpp"
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

}  // namespace equipoise
