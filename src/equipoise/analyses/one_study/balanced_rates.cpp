// Eigenvalues where nothing depends on the rotor's angle, else multipliers over a turn.
#include "equipoise/analyses/one_study/balanced_rates.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/spin_up/run_up.hpp"

namespace equipoise {

namespace {

std::optional<BalancedRates> rates_on_section(const model::System& system, const BallAngles& phi, int freedom,
                                              const StopFlag* stop) {
  // Errors of an integration over a turn; next to a multiple 1 their square root.
  constexpr double error = 1e-11, zero = 1e-5;
  const double turn = system.section_period();
  const bool rests = system.parameters().gravity == 0.0 && system.parameters().race_is_centred();
  BalancedRates found;
  Eigen::VectorXcd multipliers;
  if (rests) {
    const auto flight =
        follow_derivative(system, model::balanced_state(system, system.speed(), phi.data()), turn, 1e-12, 0.0, stop);
    if (!flight) return std::nullopt;
    multipliers = dense::eigenvalues(flight->tangents);
  } else {
    found.orbit = balanced_orbit(system, phi.data(), nullptr, stop);
    if (!found.orbit) return std::nullopt;
    multipliers = found.orbit->multipliers;
  }
  // Multipliers below the noise are known to be no larger, and nothing else.
  const double noise = error * std::max(1.0, multipliers.cwiseAbs().maxCoeff());
  const Eigen::VectorXcd rates = multipliers.unaryExpr(
      [&](std::complex<double> m) { return std::log(std::abs(m) > noise ? m : std::complex<double>(noise)) / turn; });
  found.rates = without_continuum(rates, freedom, zero);
  return found;
}

// One in each plane; empty for balls in more planes than two.
std::optional<BallAngles> polygons(const model::Parameters& p) {
  if (!p.tilts()) return model::inscribed_polygon(p);
  const std::vector<model::BallPlane> planes = model::planes_of_balls(p);
  if (planes.empty()) return std::nullopt;
  BallAngles phi{};
  for (const model::BallPlane& plane : planes) {
    const BallAngles own = model::inscribed_polygon(plane.rotor);
    for (std::size_t k = 0; k < plane.balls.size(); ++k)
      phi[static_cast<std::size_t>(plane.balls[k])] = own[k] + plane.turn;
  }
  return phi;
}

bool overlap(const BallAngles& phi, const std::vector<double>& width) {
  for (std::size_t i = 0; i < width.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (std::abs(std::remainder(phi[i] - phi[k], two_pi)) < 0.5 * (width[i] + width[k]) * (1.0 - 1e-12)) return true;
  return false;
}

}  // namespace

std::vector<std::complex<double>> without_continuum(const Eigen::VectorXcd& rates, int freedom, double zero) {
  std::vector<std::complex<double>> own(rates.begin(), rates.end());
  if (freedom > 0) {
    std::sort(own.begin(), own.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
    own.erase(own.begin(), own.begin() + freedom);
    for (auto& v : own)
      if (std::abs(v) <= zero) v = 0.0;
  }
  std::sort(own.begin(), own.end(),
            [](auto a, auto b) { return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag(); });
  return own;
}

std::optional<double> speed_in_balance(const Study& study, const model::System& system) {
  if (system.prescribed()) return system.speed();
  if (system.coasts()) return rotor_alone(study, 0.0, std::nullopt).speed;
  return model::sustained_speed(system);
}

std::optional<BallAngles> balanced_angles(const model::BalancedStates& states, const model::Parameters& p,
                                          const std::vector<double>& width) {
  using Kind = model::BalancedStates::Kind;
  if (states.kind == Kind::none) return std::nullopt;
  if (states.kind == Kind::isolated) return states.angles.front();
  if (auto spread = polygons(p); spread && model::project_to_balanced(p, spread->data()) && !overlap(*spread, width))
    return spread;
  BallAngles phi{};
  for (const double reach : {0.5, 0.9, 0.2}) {  // spread evenly on the light side, then moved into balance
    for (int i = 0; i < p.balls; ++i)
      phi[static_cast<std::size_t>(i)] = pi + reach * pi * (2.0 * (i + 0.5) / p.balls - 1.0);
    if (model::project_to_balanced(p, phi.data()) && !overlap(phi, width)) return phi;
  }
  if (width.empty()) return std::nullopt;
  phi = model::fan(p, width);
  return model::project_to_balanced(p, phi.data()) ? std::optional(phi) : std::nullopt;
}

model::System LinearRotor::with_drag(double factor) const {
  model::Parameters p = parameters;
  for (double& beta : p.drag) beta *= factor;
  return {p, speed};
}

LinearRotor linear_rotor(const Study& study, double speed, bool family) {
  LinearRotor rotor{without_events(model::System(study.parameters, speed)).parameters(), speed, 0};
  model::Parameters& p = rotor.parameters;
  const auto left_out = [&](LeftOut what) { rotor.left_out = static_cast<unsigned char>(rotor.left_out | what); };
  if (study.parameters.balls_stick()) left_out(dry_friction_left_out);
  if (p.gravity == 0.0 && p.isotropic()) return rotor;
  // Multipliers are integrated over a turn: not over one that takes for ever, nor of equations that are stiff.
  constexpr double slowest = 0.05;
  const bool can_integrate = std::fabs(speed) >= slowest && start_cost(study).bearable();
  const bool falls = p.gravity > 0.0 && p.gravity / (speed * speed) >= 1.0;
  if (p.gravity != 0.0 && (family || falls || !can_integrate)) {
    p.gravity = 0.0;
    left_out(gravity_left_out);
  }
  if (!p.isotropic() && (!can_integrate || (family && !p.race_is_centred()))) {
    p = model::weakened(p, 0.0);
    left_out(unequal_supports_left_out);
  }
  return rotor;
}

bool is_too_stiff(const model::Parameters& p, double speed) {
  constexpr double most_radians = 1e4;
  return model::highest_critical_speed(p) * two_pi > most_radians * std::fabs(speed);
}

std::optional<BalancedRates> balanced_rates(const model::System& system, const BallAngles& phi, bool family,
                                            const StopFlag* stop) {
  const int freedom = family ? model::balanced_freedom(system) : 0;
  if (!system.autonomous()) return rates_on_section(system, phi, freedom, stop);
  const std::optional<double> speed = model::balanced_speed(system);
  if (!speed) return std::nullopt;
  const Eigen::VectorXd state = model::balanced_state(system, *speed, phi.data());
  return BalancedRates{without_continuum(dense::eigenvalues(model::jacobian(system, state)), freedom, zero_rate), {}};
}

}  // namespace equipoise
