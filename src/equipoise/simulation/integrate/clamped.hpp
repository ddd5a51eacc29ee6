// Spin-up with the balls held: three linear solutions serve every start of an ensemble. Under a motor each start is
// followed by itself, and its release is located.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/system.hpp"
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

/// Follows `state` (machine/model/held_state.hpp) of a driven rotor in double precision from `from` until psi' reaches
/// `speed`, `rising` to it or falling, but at most to `to`. Empty if it does not reach it, or is lost. `state` ends at
/// the returned time, else at `to`.
std::optional<double> find_release(const model::System& system, double speed, bool rising, double from, double to,
                                   double* state);

}  // namespace equipoise
