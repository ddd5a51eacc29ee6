// Spin-up with the balls held: three linear solutions serve every start of an ensemble.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/results/types/status.hpp"

namespace equipoise {

/// (x, y, u, v) = base + Ux times per_x + Uy times per_y with the unbalance U = lambda + sum mu_i e^{i phi_i}.
struct ClampedBasis {
  std::array<double, 12> values{};  ///< base, per_x, per_y; each x, y, u, v

  /// Centre O with the balls held at `phi`; writes x, y, u, v.
  void centre(const model::Parameters& p, const double* phi, double* xyuv) const;
};

/// Called with the time, the segment it lies in and the basis there.
using ClampedObserver = std::function<void(double t, const model::Segment& segment, const ClampedBasis& basis)>;

/// Integrates from t = 0 with (x, y, u, v) = `initial` through all clamped segments; `basis` ends as it is at release,
/// after any jump of psi' there. Calls `observe` at those of `times` (increasing) that lie before release. Returns
/// early, as `done`, at `until` or once `stop` is set.
IntegrationStatus integrate_clamped(const model::Parameters& p, const std::vector<model::Segment>& segments,
                                    const std::array<double, 4>& initial, double tolerance, ClampedBasis& basis,
                                    const std::vector<double>& times = {}, const ClampedObserver& observe = {},
                                    double until = std::numeric_limits<double>::infinity(),
                                    const StopFlag* stop = nullptr);

}  // namespace equipoise
