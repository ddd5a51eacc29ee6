// Speed, balanced states, linear rotor, rates; the more stable of the states.
#include "equipoise/extras/stability/balance_at.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "equipoise/analyses/basin_slices/start_pixels.hpp"
#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

namespace {

// The rotor that turns as the study says, as far as linear theory knows it.
model::System linear_system(const model::System& system, LinearRotor& rotor) {
  if (system.prescribed()) return rotor.system();
  if (!system.coasts() && rotor.system().autonomous()) return {rotor.parameters, system.drive()};
  rotor.left_out |= motor_left_out;
  return rotor.system();
}

// Whether all balanced states have the same eigenvalues. The two of a plane rotor are mirror images, on equal supports
// or of balls that are alike. For a tilting rotor, whose planes may close their polygons this way or that, each by
// itself, they have if the balls of either plane are alike.
bool same_rates(const model::System& system) {
  const model::Parameters& p = system.parameters();
  if (!p.tilts()) return p.alike(0, 1) || (system.autonomous() && p.race_is_centred());
  std::set<double> planes(p.tilt.plane.begin(), p.tilt.plane.begin() + p.balls);
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (p.tilt.plane[static_cast<std::size_t>(i)] == p.tilt.plane[static_cast<std::size_t>(k)] && !p.alike(i, k))
        return false;
  return planes.size() <= 2;
}

int unstable_of(const std::vector<std::complex<double>>& rates) {
  const auto grows = [](const std::complex<double>& rate) { return rate.real() > least_rate; };
  return static_cast<int>(std::count_if(rates.begin(), rates.end(), grows));
}

void take_rates(const std::vector<std::complex<double>>& rates, BalancePoint& point) {
  const std::complex<double> slowest = rates.front();
  point.growth = slowest.real();
  point.frequency = std::fabs(slowest.imag());
  point.unstable = static_cast<short>(unstable_of(rates));
  point.kind = point.unstable > 0           ? BalanceKind::unstable
               : point.growth < -least_rate ? BalanceKind::stable
                                            : BalanceKind::marginal;
}

}  // namespace

BalancePoint balance_at(const Study& study, const StopFlag* stop) {
  using States = model::BalancedStates;
  BalancePoint point;
  point.kind = BalanceKind::none;
  const model::System system = study.system();
  const auto speed = speed_in_balance(study, system);
  if (!speed || *speed == 0.0) return point;
  const model::CentredTwin twin = model::centred_twin(study.parameters, *speed);
  point.margin = balance_margin(twin.parameters);
  point.contact = study.parameters.balls_collide();
  const States states = model::balanced_states(twin.parameters);
  if (states.kind == States::Kind::none) return point;
  point.kind = BalanceKind::unknown;
  const bool family = states.kind == States::Kind::continuum;
  point.one_of_many = family;
  std::vector<BallAngles> members = states.angles;
  if (family) {
    const model::Parameters& p = twin.parameters;
    const std::vector<double> width(p.balls_collide() ? static_cast<std::size_t>(p.balls) : 0, p.contact_angle);
    const auto member = balanced_angles(states, p, width);
    if (!member) return point;
    members.push_back(*member);
  }
  LinearRotor rotor = linear_rotor(study, *speed, family);
  const model::System linear = linear_system(system, rotor);
  point.left_out = rotor.left_out;
  point.by_multipliers = !linear.autonomous();
  const std::size_t different = same_rates(linear) ? 1 : members.size();
  point.of_several = different > 1;
  for (std::size_t k = 0; k < different; ++k) {
    BallAngles phi = members[k];
    for (int i = 0; i < twin.parameters.balls; ++i) phi[static_cast<std::size_t>(i)] += twin.turn;
    const auto found = balanced_rates(linear, phi, family, stop);
    if (!found || (std::isfinite(point.growth) && found->rates.front().real() >= point.growth)) continue;
    take_rates(found->rates, point);
  }
  return point;
}

std::optional<ContinuumPart> continuum_at(const Study& study, const StopFlag* stop) {
  const model::System system = study.system();
  const auto speed = speed_in_balance(study, system);
  if (!speed || *speed == 0.0) return std::nullopt;
  const model::CentredTwin twin = model::centred_twin(study.parameters, *speed);
  if (model::balanced_states(twin.parameters).kind != model::BalancedStates::Kind::continuum) return std::nullopt;
  LinearRotor rotor = linear_rotor(study, *speed, true);
  const model::System linear = linear_system(system, rotor);
  model::Parameters with_room = linear.parameters();
  with_room.contact_angle = study.parameters.contact_angle;  // members whose balls overlap are none
  const model::System drawn(with_room, linear.drive());
  if (!ContinuumOfEquilibria::is_of(drawn)) return std::nullopt;
  const ContinuumPart part = ContinuumOfEquilibria(drawn).sample(stop);
  return part.drawn > 0 ? std::optional(part) : std::nullopt;
}

int BalanceSpectrum::unstable() const { return unstable_of(rates); }

std::optional<BalanceSpectrum> balance_spectrum(const Study& study) {
  const model::System given = study.system();
  const auto speed = speed_in_balance(study, given);
  if (!speed || *speed == 0.0) return std::nullopt;
  const model::Parameters& p = study.parameters;
  const model::BalancedStates states = model::balanced_states(p);
  const bool family = states.kind == model::BalancedStates::Kind::continuum;
  const std::vector<double> width(family && p.balls_collide() ? static_cast<std::size_t>(p.balls) : 0, p.contact_angle);
  const auto first = balanced_angles(states, p, width);
  if (!first) return std::nullopt;
  const LinearRotor rotor = linear_rotor(study, *speed, family);
  const model::System system =
      given.prescribed() || given.coasts() ? rotor.system() : model::System(rotor.parameters, given.drive());
  const auto spectrum_at = [&](const BallAngles& phi) {
    BalanceSpectrum found{system, model::balanced_state(system, *speed, phi.data()), {}, {}, family};
    found.jacobian = model::jacobian(system, found.state);
    found.rates =
        without_continuum(dense::eigenvalues(found.jacobian), family ? model::balanced_freedom(system) : 0, zero_rate);
    return found;
  };
  BalanceSpectrum best = spectrum_at(*first);
  if (!p.tilts() || family) return best;
  for (std::size_t k = 1; k < states.angles.size(); ++k) {
    BalanceSpectrum other = spectrum_at(states.angles[k]);
    if (other.rates.front().real() < best.rates.front().real() - zero_rate) best = std::move(other);
  }
  return best;
}

std::optional<EigenPair> nearest_pair(const std::vector<std::complex<double>>& rates, const EigenPair& like) {
  std::optional<EigenPair> best;
  double least = INFINITY;
  for (std::size_t i = 0; i < rates.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const bool pair =
          rates[i].imag() == -rates[k].imag() && (rates[i].imag() == 0.0 || rates[i].real() == rates[k].real());
      if (!pair) continue;
      const EigenPair found{0.5 * (rates[i].real() + rates[k].real()), (rates[i] * rates[k]).real(), {k, i}};
      const double distance = std::hypot(found.mean - like.mean, found.product - like.product);
      if (distance < least) {
        least = distance;
        best = found;
      }
    }
  return best;
}

}  // namespace equipoise
