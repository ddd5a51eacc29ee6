// Continues orbits in gravity and anisotropy, and follows trajectories while these fade.
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

model::System weakened(const model::System& system, double share) {
  return {model::weakened(system.parameters(), share), system.drive()};
}

// A driven rotor's angle must stay part of the state, so this much is left when gravity and anisotropy are off.
double least_share(const model::System& system) { return system.prescribed() ? 0.0 : 1e-6; }

// Shifts the centre of a state at rotor angle `psi`: it keeps its distance from the rest position, now that of `to`
// instead of `from`. A soft rotor sags by more than it ever vibrates.
void shift_to_rest(const model::Parameters& from, const model::Parameters& to, double psi, double* state) {
  const auto before = model::rest_position(from, psi), after = model::rest_position(to, psi);
  state[model::index::x] += after[0] - before[0];
  state[model::index::y] += after[1] - before[1];
}

// Converts states from one share of gravity and anisotropy to another.
std::vector<VectorXd> hung_anew(const model::System& from, const model::System& to, std::vector<VectorXd> states) {
  for (VectorXd& z : states)
    shift_to_rest(from.parameters(), to.parameters(), to.layout().psi < 0 ? 0.0 : z[to.layout().psi], z.data());
  return states;
}

// The orbit of one section at a share, close to an orbit at another share. At a prescribed speed the section stays even
// if nothing depends on the rotor's angle any more.
std::optional<PeriodicOrbit> orbit_at(const model::System& system, const PeriodicOrbit& near, double near_share,
                                      double share, const StopFlag* stop) {
  // A branch moves less than this, in System::scale(), over one step; a larger move may lead to another branch.
  constexpr double farthest = 0.25;
  const model::System weak = weakened(system, share);
  const std::vector<VectorXd> nodes = hung_anew(weakened(system, near_share), weak, near.nodes);
  const auto found = system.prescribed() ? refine_imposed_orbit(weak, nodes, system.section_period(), farthest, stop)
                                         : refine_orbit(weak, nodes, near.period, farthest, stop);
  if (!found) return std::nullopt;
  const auto still = [](int turns) { return turns == 0; };
  const bool captured = std::all_of(found->winding.begin(), found->winding.begin() + system.balls(), still);
  return captured ? found : std::nullopt;
}

// Continues an orbit of one section from share `from` to share `to`, in steps that are halved when they fail.
// `reached`: the share that it came to.
std::optional<PeriodicOrbit> continued(const model::System& system, PeriodicOrbit orbit, double from, double to,
                                       double* reached = nullptr, const StopFlag* stop = nullptr) {
  constexpr double first_step = 0.25, smallest_step = 1.0 / 512;
  const double direction = to > from ? 1.0 : -1.0;
  double at = from, step = first_step;
  while (at != to) {
    if (reached) *reached = at;
    const double next = std::fabs(to - at) <= step * (1.0 + 1e-9) ? to : at + direction * step;
    const auto found = orbit_at(system, orbit, at, next, stop);
    if (is_set(stop)) return std::nullopt;
    if (!found) {
      step *= 0.5;
      if (step < smallest_step) return std::nullopt;
      continue;
    }
    orbit = *found;
    at = next;
    step = std::min(1.5 * step, first_step);
  }
  if (reached) *reached = to;
  return orbit;
}

// The state without the rotor's angle, for when nothing depends on it.
VectorXd without_angle(const model::System& system, const VectorXd& state) {
  if (system.layout().psi < 0) return state;
  VectorXd result(state.size() - 1);
  const Eigen::Index before = system.layout().psi;
  result << state.head(before), state.tail(state.size() - before - 1);
  return result;
}

}  // namespace

std::optional<VectorXd> at_next_section(const model::System& system, const VectorXd& state, double psi,
                                        double tolerance) {
  if (system.section() != model::Section::stroboscopic) return state;
  const double angle = system.section_angle(), speed = system.speed(), sense = speed < 0.0 ? -1.0 : 1.0;
  double ahead = std::fmod(-sense * psi, angle);
  if (ahead < 0.0) ahead += angle;
  // Rounding of psi after 10^4 turns must not cost a whole section: this close to one counts as on it.
  if (ahead < 1e-9 || angle - ahead < 1e-9) return state;
  return advance_state(system, state, ahead / std::fabs(speed), psi, tolerance);
}

std::optional<PeriodicOrbit> balanced_orbit(const model::System& system, const double* phi, double* reached,
                                            const StopFlag* stop) {
  if (reached) *reached = 0.0;
  const auto speed = model::balanced_speed(system);
  if (!speed || *speed == 0.0) return std::nullopt;
  PeriodicOrbit start;
  start.nodes = {model::balanced_state(system, *speed, phi)};
  start.period = system.section_angle() / std::fabs(*speed);
  const double from = least_share(system);
  if (from > 0.0) {
    const auto weak = orbit_at(system, start, 0.0, from, stop);
    if (!weak) return std::nullopt;
    start = *weak;
  }
  return continued(system, start, from, 1.0, reached, stop);
}

bool leads_to_balance(const model::System& system, const PeriodicOrbit& orbit) {
  // For lambda + sum mu_i: rounding, and a small share of what continuation's Newton steps leave.
  constexpr double centred = 1e-7;
  const auto still = [](int turns) { return turns == 0; };
  if (!std::all_of(orbit.winding.begin(), orbit.winding.begin() + system.balls(), still)) return false;
  if (orbit.imposed ? orbit.nodes.size() != 1 : std::abs(orbit.winding[system.balls()]) != 1) return false;
  const auto end = continued(system, orbit, 1.0, least_share(system));
  if (!end) return false;
  VectorXd state = without_angle(system, end->nodes[0]);
  if (!system.prescribed()) {  // takes off the rest of gravity and anisotropy
    const auto rest = refine_equilibrium(weakened(system, 0.0), state);
    if (!rest || !((rest->state - state).lpNorm<Eigen::Infinity>() < 0.01)) return false;
    state = rest->state;
  }
  return model::off_balance(system.parameters(), state) < centred * system.scale()[0];
}

bool relaxes_to_balance(const model::System& system, const VectorXd& state) {
  constexpr int fading = 400, settling = 400;
  // In System::scale(): what the fading leaves, about e^-10, against motions that are not balanced (0.01 or more).
  constexpr double centred = 1e-3;
  VectorXd z = state;
  for (int k = 1; k <= fading + settling; ++k) {
    const auto share_after = [](int sections) { return std::max(0.0, 1.0 - static_cast<double>(sections) / fading); };
    const model::System weak = weakened(system, share_after(k));
    z = hung_anew(weakened(system, share_after(k - 1)), weak, {z}).front();
    auto next = advance_state(weak, z, system.section_period());
    if (!next) return false;
    z = *std::move(next);
  }
  double phi[model::max_balls];
  for (int i = 0; i < system.balls(); ++i) {
    phi[i] = z[model::index::phi(i)];
    if (std::fabs(phi[i] - state[model::index::phi(i)]) > 0.5 * pi) return false;
  }
  if (!model::project_to_balanced(system, system.speed(), phi)) return false;
  const VectorXd away = z - model::balanced_state(system, system.speed(), phi);
  return away.cwiseQuotient(system.scale()).lpNorm<Eigen::Infinity>() < centred;
}

}  // namespace equipoise
