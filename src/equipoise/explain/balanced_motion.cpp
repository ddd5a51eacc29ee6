// Eigenvalues at a balanced state, or multipliers over the time after which the equations repeat themselves.
#include "equipoise/explain/balanced_motion.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equipoise/attractor_search/cost.hpp"
#include "equipoise/attractors/event_motion.hpp"
#include "equipoise/base/angles.hpp"
#include "equipoise/explain/drag_scan.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/mechanics/fan.hpp"
#include "equipoise/mechanics/linearisation.hpp"
#include "equipoise/model/stroboscopic_section.hpp"
#include "equipoise/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/periodic_orbits/variational.hpp"
#include "equipoise/words/explain.hpp"

namespace equipoise {

namespace {

using Angles = std::array<double, model::max_balls>;

struct Linear {
  std::vector<std::complex<double>> rates;  // slowest first
  std::optional<double> left;
};

// As much of the rotor as linear theory knows.
struct LinearRotor {
  model::Parameters parameters;
  double speed;
  std::string less;

  model::System system() const { return {parameters, speed}; }
  model::System with_drag(double factor) const {
    model::Parameters p = parameters;
    for (double& beta : p.drag) beta *= factor;
    return {p, speed};
  }
};

LinearRotor linear_rotor(const Explanation& e, bool family) {
  LinearRotor rotor{without_events(model::System(e.study.parameters, *e.speed)).parameters(), *e.speed, ""};
  model::Parameters& p = rotor.parameters;
  // Multipliers are integrated over a turn: not over one that takes for ever, nor of equations that are stiff.
  constexpr double slowest = 0.05;
  const bool can_integrate = std::fabs(rotor.speed) >= slowest && start_cost(e.study).bearable();
  const auto left_out = [&](const char* words) { rotor.less += (rotor.less.empty() ? "" : ", ") + std::string(words); };
  if (e.study.parameters.balls_stick()) left_out(words::explain::without_dry_friction);
  const bool falls = e.gravity_ratio && *e.gravity_ratio >= 1.0;
  if (p.gravity != 0.0 && (family || falls || !can_integrate)) {
    p.gravity = 0.0;
    left_out(words::explain::without_gravity);
  }
  if (!p.isotropic() && (!can_integrate || (family && !p.race_is_centred()))) {
    p = model::weakened(p, 0.0);
    left_out(words::explain::with_means);
  }
  return rotor;
}

// How far the race's centre moves from where it rests while the balls rock.
double farthest(const model::System& system, const PeriodicOrbit& orbit) {
  constexpr int looks = 64;
  const auto& offset = system.parameters().race_offset;
  const double sense = system.speed() < 0.0 ? -1.0 : 1.0;
  double most = 0.0;
  int k = 0;
  for (const Eigen::VectorXd& z : sample_orbit(system, orbit, looks)) {
    const auto rest = model::rest_position(system.parameters(), sense * system.section_angle() * k++ / looks);
    most = std::max(most, std::hypot(z[0] + offset[0] - rest[0], z[1] + offset[1] - rest[1]));
  }
  return most;
}

std::optional<Linear> linear_on_section(const model::System& system, const Angles& phi, int freedom) {
  // Errors of an integration over a turn; beside a multiple 1 their square root.
  constexpr double error = 1e-11, zero = 1e-5;
  const double turn = system.section_period();
  const bool rests = system.parameters().gravity == 0.0 && system.parameters().race_is_centred();
  Linear linear;
  Eigen::VectorXcd multipliers;
  if (rests) {
    const auto flight =
        follow_derivative(system, model::balanced_state(system, system.speed(), phi.data()), turn, 1e-12);
    if (!flight) return std::nullopt;
    multipliers = dense::eigenvalues(flight->tangents);
  } else {
    const auto orbit = balanced_orbit(system, phi.data());
    if (!orbit) return std::nullopt;
    multipliers = orbit->multipliers;
    linear.left = farthest(system, *orbit);
  }
  // Multipliers below the noise are known to be no larger, and nothing else.
  const double noise = error * std::max(1.0, multipliers.cwiseAbs().maxCoeff());
  const Eigen::VectorXcd rates = multipliers.unaryExpr(
      [&](std::complex<double> m) { return std::log(std::abs(m) > noise ? m : std::complex<double>(noise)) / turn; });
  linear.rates = without_continuum(rates, freedom, zero);
  return linear;
}

std::optional<Linear> linear_motion(const model::System& system, const Angles& phi, bool family) {
  const int freedom = family ? model::balanced_freedom(system) : 0;
  if (!system.autonomous()) return linear_on_section(system, phi, freedom);
  const Eigen::VectorXd state = model::balanced_state(system, system.speed(), phi.data());
  return Linear{without_continuum(dense::eigenvalues(model::jacobian(system, state)), freedom, zero_rate), {}};
}

bool overlap(const Angles& phi, const std::vector<double>& width) {
  for (std::size_t i = 0; i < width.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (std::abs(std::remainder(phi[i] - phi[k], two_pi)) < 0.5 * (width[i] + width[k]) * (1.0 - 1e-12)) return true;
  return false;
}

}  // namespace

std::optional<Angles> balanced_angles(const model::BalancedStates& states, const model::Parameters& p,
                                      const std::vector<double>& width) {
  using Kind = model::BalancedStates::Kind;
  if (states.kind == Kind::none) return std::nullopt;
  if (states.kind == Kind::isolated) return states.angles.front();
  Angles phi{};
  for (const double reach : {0.5, 0.9, 0.2}) {  // spread evenly on the light side, then moved into balance
    for (int i = 0; i < p.balls; ++i)
      phi[static_cast<std::size_t>(i)] = pi + reach * pi * (2.0 * (i + 0.5) / p.balls - 1.0);
    if (model::project_to_balanced(p, phi.data()) && !overlap(phi, width)) return phi;
  }
  if (width.empty()) return std::nullopt;
  phi = model::fan(p, width);
  return model::project_to_balanced(p, phi.data()) ? std::optional(phi) : std::nullopt;
}

void linearise(Explanation& e) {
  const auto skip = [&](const std::string& why) { e.no_motion = why; };
  if (!e.speed) return skip(e.speed_words);
  if (*e.speed == 0.0) return skip(words::explain::no_turning);
  if (e.balanced.kind == model::BalancedStates::Kind::none) return skip(words::explain::no_balanced_state);
  const model::CentredTwin twin = model::centred_twin(e.study.parameters, *e.speed);
  const auto angles = balanced_angles(e.balanced, twin.parameters, e.ball_width);
  if (!angles) return skip(words::explain::none_in_continuum);
  const bool family = e.balanced.kind == model::BalancedStates::Kind::continuum;
  const LinearRotor rotor = linear_rotor(e, family);
  BalancedMotion motion;
  motion.angles = *angles;
  for (int i = 0; i < twin.parameters.balls; ++i) motion.angles[static_cast<std::size_t>(i)] += twin.turn;
  const auto linear = linear_motion(rotor.system(), motion.angles, family);
  if (!linear) {
    const bool gravity = rotor.parameters.gravity != 0.0, uneven = !rotor.parameters.isotropic();
    return skip(std::string(words::explain::no_balanced_motion_with) + (gravity ? "gravity" : "") +
                (gravity && uneven ? " and " : "") + (uneven ? words::explain::unequal_supports : ""));
  }
  motion.less = rotor.less;
  motion.section_period = rotor.system().autonomous() ? 0.0 : rotor.system().section_period();
  motion.left = linear->left;
  motion.eigenvalues = linear->rates;
  motion.slowest_rate = motion.eigenvalues.front().real();
  motion.stable = motion.slowest_rate < -least_rate;
  constexpr double part = 1e-3;  // of the drag: a difference far above rounding, far below what bends the curve
  const auto more = linear_motion(rotor.with_drag(1.0 + part), motion.angles, family);
  const auto less = linear_motion(rotor.with_drag(1.0 - part), motion.angles, family);
  if (more && less && motion.slowest_rate != 0.0)
    motion.drag_sensitivity =
        (more->rates.front().real() - less->rates.front().real()) / (2.0 * part * motion.slowest_rate);
  if (rotor.parameters.rolls) {
    LinearRotor sliding = rotor;
    sliding.parameters.rolls = false;
    if (const auto slid = linear_motion(sliding.system(), motion.angles, family))
      motion.slowest_if_sliding = slid->rates.front().real();
  }
  e.motion = motion;
}

}  // namespace equipoise
