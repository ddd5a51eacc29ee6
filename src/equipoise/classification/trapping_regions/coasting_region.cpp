// Compares the energy with that at the stall speed; follows short flights towards balance.
#include "equipoise/classification/trapping_regions/coasting_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/attractors/periodic_orbits/return_map.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/results/types/outcome.hpp"

namespace equipoise {

namespace {

// In System::scale(). Farther from balance linear theory has nothing to say.
constexpr double rest_reach = 0.2;

// Of rotor and balls hanging on the springs. Balls and unbalance are above the shaft as often as below.
double least_potential_energy(const model::Parameters& p) {
  const double weight = (1.0 + p.total_mass()) * p.gravity;
  return -0.5 * weight * weight / p.stiffness[1];
}

// Power that the supports' dampers take from a rotor that goes round at distance r.
double support_loss(const model::Parameters& p, double speed, double r) {
  return std::max(p.damping[0], p.damping[1]) * speed * speed * r * r;
}

// The most that supports and drag can take from a motion at a prescribed speed: the rotor goes round at its largest r,
// and every ball slips at its greatest rate.
double most_loss(const model::Parameters& p, const Motion& motion) {
  double loss = support_loss(p, motion.speed, motion.r_max);
  for (int i = 0; i < p.balls; ++i) {
    const double rate = std::max(std::fabs(motion.rate_min[i]), std::fabs(motion.rate_max[i]));
    loss += p.mass[i] * p.drag[i] * rate * rate;
  }
  return loss;
}

}  // namespace

CoastingRegion::CoastingRegion(const model::System& system, double stall_speed, double horizon)
    : system_(system), horizon_(horizon), least_energy_(least_potential_energy(system.parameters())) {
  const model::Parameters& p = system.parameters();
  model::Parameters at_speed = p;
  at_speed.gravity = 0.0;
  const model::CentredTwin twin = model::centred_twin(p, stall_speed > 0.0 ? stall_speed : 1.0);
  balances_ = model::balanced_states(twin.parameters).kind != model::BalancedStates::Kind::none;
  exact_ = p.gravity == 0.0 && p.race_is_centred() && !system.events().stick;
  std::array<double, model::largest_state> state{};
  state[model::machine_layout(p.balls).speed] = stall_speed;
  least_energy_ += model::full_energy(at_speed, state.data());
}

double CoastingRegion::energy(const double* state) const {
  const model::Parameters& p = system_.parameters();
  std::array<double, model::largest_state> all{};
  model::copy_state(system_.layout(), state, model::machine_layout(p.balls), all.data());
  return model::full_energy(p, all.data());
}

bool CoastingRegion::stalls(const double* state) const { return energy(state) < least_energy_; }

// Tested often: a state far from balance shows it in the balls.
bool CoastingRegion::is_near(const double* state) const {
  const model::Parameters& p = system_.parameters();
  const double speed = state[system_.layout().speed];
  if (!balances_ || speed == 0.0) return false;
  const model::CentredTwin twin = model::centred_twin(p, speed);
  const std::complex<double> rest =
      p.eccentricity - std::polar(twin.parameters.eccentricity, twin.turn);  // 0 except with an off-centre race
  // Weight rocks the balls once a turn. Otherwise hardly any speed is still to be lost this near to balance.
  const double rocking = 2.0 * p.gravity / std::min(std::fabs(speed), speed * speed);
  const double reach = exact_ ? rest_reach : 0.5 * rest_reach + rocking;
  if (std::abs(model::unbalance(p, state + model::index::phi(0)) - rest) > reach * p.all_unbalances()) return false;
  for (int i = 0; i < p.balls; ++i)
    if (std::fabs(state[model::index::q(i, p.balls)]) > reach) return false;
  const double loss = support_loss(p, speed, std::hypot(p.race_offset[0], p.race_offset[1]));
  return exact_ || loss * horizon_ < energy(state) - least_energy_;
}

Caught CoastingRegion::approaches(const Eigen::VectorXd& state) const {
  constexpr double soon = 16.0, longest = 2000.0, arrived = 1e-5;
  const StateDifference difference(system_);
  const auto begin = nearest_balanced(system_, state, rest_reach);
  if (!begin || !begin->attracts) return {0, soon};
  const double first = difference.distance(state, begin->state);
  if (!(first < rest_reach)) return {0, soon};
  const double time = std::min(2.0 / -begin->rate, longest);
  const auto later = after(system_, state, time);
  const auto end = later ? nearest_balanced(system_, *later, rest_reach) : std::nullopt;
  if (!end || !end->attracts) return {0, time};
  const double last = difference.distance(*later, end->state);
  const bool comes = last < arrived || last < first * std::exp(0.5 * begin->rate * time);
  return {comes ? balanced_id : 0, time};
}

Caught CoastingRegion::balances(const double* state, const StopFlag* stop) const {
  if (!is_near(state)) return {};
  const Eigen::Map<const Eigen::VectorXd> y(state, system_.dimension());
  if (exact_) return approaches(y);
  // Sticking balls leave the unbalance that they then have.
  const AtSpeed now = at_present_speed(y);
  if (system_.events().stick && !stuck_for_good(now.system, now.state, now.psi)) return {};
  const auto motion = lasting_motion(y, stop);
  const bool comes = motion && motion_name(system_.parameters(), *motion).id == balanced_id;
  return {comes ? balanced_id : 0, first_stretch};
}

CoastingRegion::AtSpeed CoastingRegion::at_present_speed(const Eigen::VectorXd& state) const {
  const model::System prescribed(system_.parameters(), system_.speed(state));
  return {prescribed, state.head(prescribed.dimension()), system_.layout().psi < 0 ? 0.0 : state[system_.layout().psi]};
}

std::optional<Motion> CoastingRegion::lasting_motion(const Eigen::VectorXd& state, const StopFlag* stop) const {
  const auto [prescribed, own, psi] = at_present_speed(state);
  if (prescribed.speed() == 0.0) return std::nullopt;
  std::optional<Motion> motion;
  if (const auto end = stuck_for_good(prescribed, own, psi))
    motion = describe_stuck(prescribed, *end);
  else if (const auto on_section = at_next_section(without_events(prescribed), own, psi))
    motion = motion_from(prescribed, *on_section, motion_patience, stop);
  if (!motion || !motion->stable) return std::nullopt;
  const double left = energy(state.data()) - least_energy_;
  if (!(most_loss(system_.parameters(), *motion) * horizon_ < left)) return std::nullopt;
  return motion;
}

}  // namespace equipoise
