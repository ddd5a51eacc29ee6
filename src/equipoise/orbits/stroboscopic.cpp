// Continuation of orbits in gravity and anisotropy, and trajectories while these fade.
#include "equipoise/orbits/stroboscopic.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

model::System weakened(const model::System& system, double share) {
  return {model::weakened(system.parameters(), share), system.drive()};
}

// Follows an orbit of one strobe from `orbit` at share `from` to share `to`, in steps that are halved where they fail.
// The strobe stays what it is where nothing is left to ask for it.
std::optional<PeriodicOrbit> continued(const model::System& system, PeriodicOrbit orbit, double from, double to) {
  constexpr double first_step = 0.25, smallest_step = 1.0 / 512;
  // A branch moves less than this, in System::scale(), over one step; what moves more may be another branch.
  constexpr double farthest = 0.25;
  const double strobe = system.strobe_period(), direction = to > from ? 1.0 : -1.0;
  double at = from, step = first_step;
  while (at != to) {
    const double next = std::fabs(to - at) <= step * (1.0 + 1e-9) ? to : at + direction * step;
    const auto found = refine_imposed_orbit(weakened(system, next), orbit.nodes, strobe, farthest);
    if (!found || found->winding != Winding{}) {
      step *= 0.5;
      if (step < smallest_step) return std::nullopt;
      continue;
    }
    orbit = *found;
    at = next;
    step = std::min(1.5 * step, first_step);
  }
  return orbit;
}

}  // namespace

std::optional<VectorXd> at_next_strobe(const model::System& system, const VectorXd& state, double psi) {
  if (system.autonomous()) return state;
  const double angle = system.strobe_angle(), speed = system.speed(), sense = speed < 0.0 ? -1.0 : 1.0;
  double ahead = std::fmod(-sense * psi, angle);
  if (ahead < 0.0) ahead += angle;
  // Rounding of psi after 10^4 turns must not cost a whole one; what is this near a strobe is at it.
  if (ahead < 1e-9 || angle - ahead < 1e-9) return state;
  return advance_state(system, state, ahead / std::fabs(speed), psi);
}

std::optional<PeriodicOrbit> balanced_orbit(const model::System& system, const double* phi) {
  PeriodicOrbit start;
  start.nodes = {model::centred_state(system.parameters(), phi)};
  return continued(system, start, 0.0, 1.0);
}

bool leads_to_balance(const model::System& system, const PeriodicOrbit& orbit) {
  // Of lambda + sum mu_i: rounding and a small share of what continuation's Newton steps leave.
  constexpr double centred = 1e-7;
  if (orbit.nodes.size() != 1 || orbit.winding != Winding{}) return false;
  const auto end = continued(system, orbit, 1.0, 0.0);
  return end && std::hypot(end->nodes[0][0], end->nodes[0][1]) < centred * system.scale()[0];
}

bool relaxes_to_balance(const model::System& system, const VectorXd& state) {
  constexpr int fading = 400, settling = 400;
  // In System::scale(): what is left of the switching, some e^-10, against motions that are not balanced (0.01 or
  // more).
  constexpr double centred = 1e-3;
  VectorXd z = state;
  for (int k = 1; k <= fading + settling; ++k) {
    const double share = std::max(0.0, 1.0 - static_cast<double>(k) / fading);
    auto next = advance_state(weakened(system, share), z, system.strobe_period());
    if (!next) return false;
    z = *std::move(next);
  }
  double phi[model::max_balls];
  for (int i = 0; i < system.balls(); ++i) {
    phi[i] = z[model::index::phi(i)];
    if (std::fabs(phi[i] - state[model::index::phi(i)]) > 0.5 * pi) return false;
  }
  const model::System plain = weakened(system, 0.0);
  if (!model::project_to_balanced(plain.parameters(), phi)) return false;
  const VectorXd away = z - model::centred_state(plain.parameters(), phi);
  return away.cwiseQuotient(system.scale()).lpNorm<Eigen::Infinity>() < centred;
}

}  // namespace equipoise
