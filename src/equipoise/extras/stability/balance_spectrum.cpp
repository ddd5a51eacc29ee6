// As extras/stability/balance_at.cpp finds the state. All balanced states are alike, unless the rotor tilts.
#include "equipoise/extras/stability/balance_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

int BalanceSpectrum::unstable() const {
  return static_cast<int>(
      std::count_if(rates.begin(), rates.end(), [](const auto& rate) { return rate.real() > least_rate; }));
}

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
