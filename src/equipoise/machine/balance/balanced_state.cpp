// Balanced states: closed forms for one and two balls, Newton's method on the continuum for more.
#include "equipoise/machine/balance/balanced_state.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/machine/model/unbalance.hpp"

namespace equipoise::model {

namespace {
// Masses and unbalance count as equal below this relative difference. Values that a user calls equal agree to the last
// digits, and a real difference this small moves the balanced state by less than 1e-6 rad.
constexpr double equal_within = 1e-12;
}  // namespace

BalancedStates balanced_states(const Parameters& p) {
  BalancedStates result;
  const double lambda = p.eccentricity, total = p.total_mass();
  if (p.gravity != 0.0) {
    result.reason = "gravity keeps the balls moving in the rotating frame";
    return result;
  }
  if (p.tilts()) return tilt_balanced_states(p);
  double largest = lambda;
  for (int i = 0; i < p.balls; ++i) largest = std::max(largest, p.mass[i]);
  const double slack = lambda + total - 2.0 * largest;
  if (slack < -equal_within * (lambda + total)) {
    result.reason = p.balls == 1        ? lone_ball
                    : lambda == largest ? "the unbalance is larger than all balls together can cancel"
                                        : "one ball outweighs the unbalance and the other balls together";
    return result;
  }
  if (p.balls_collide()) {
    const Cancelling room = cancelling(p);
    if (!room.cancels(lambda)) {
      result.reason = room.why_not(lambda);
      return result;
    }
  }
  if (lambda > 0.0 && slack <= equal_within * (lambda + total)) {
    // Equality: one state, all balls on one line. The largest balances the rest: lambda at 0, or one ball at pi.
    result.kind = BalancedStates::Kind::isolated;
    std::array<double, max_balls> phi{};
    for (int i = 0; i < p.balls; ++i) phi[i] = lambda == largest || p.mass[i] == largest ? pi : 0.0;
    result.angles.push_back(phi);
    return result;
  }
  if (p.balls > 2 || lambda == 0.0) {
    result.kind = BalancedStates::Kind::continuum;
    return result;
  }
  const double m1 = p.mass[0], m2 = p.mass[1];
  const double c1 = std::clamp((m2 * m2 - lambda * lambda - m1 * m1) / (2.0 * lambda * m1), -1.0, 1.0);
  const double c2 = std::clamp((m1 * m1 - lambda * lambda - m2 * m2) / (2.0 * lambda * m2), -1.0, 1.0);
  const double phi1 = std::acos(c1), phi2 = std::acos(c2);
  result.kind = BalancedStates::Kind::isolated;
  result.angles.push_back({phi1, -phi2});
  result.angles.push_back({-phi1, phi2});
  return result;
}

namespace {

// Angles within a turn: the last digits of larger angles are coarser than the target.
bool project_within_a_turn(const Parameters& p, double* phi) {
  const double target = 1e-15 * p.all_unbalances();
  for (int iteration = 0; iteration < 30; ++iteration) {
    const std::complex<double> left = unbalance(p, phi);
    if (std::abs(left) <= 4.0 * target) return true;
    const double gx = left.real(), gy = left.imag();
    double a = 0.0, b = 0.0, d = 0.0;
    for (int i = 0; i < p.balls; ++i) {
      const double s = p.mass[i] * std::sin(phi[i]), c = p.mass[i] * std::cos(phi[i]);
      a += s * s;
      b -= s * c;
      d += c * c;
    }
    // Least change by the pseudo-inverse of the 2 x 2 matrix J J^T. Its smaller eigenvalue vanishes if all balls lie on
    // one line through the centre. The residual in that direction is of second order and shrinks by itself.
    const double mean = 0.5 * (a + d), half = std::hypot(0.5 * (a - d), b);
    const double angle = 0.5 * std::atan2(b, 0.5 * (a - d));  // of the larger eigenvalue's direction
    const double ex = std::cos(angle), ey = std::sin(angle);
    const double along = (gx * ex + gy * ey) / (mean + half);
    const double across = mean - half > 1e-9 * mean ? (gy * ex - gx * ey) / (mean - half) : 0.0;
    const double lx = along * ex - across * ey, ly = along * ey + across * ex;
    for (int i = 0; i < p.balls; ++i) phi[i] -= p.mass[i] * (-std::sin(phi[i]) * lx + std::cos(phi[i]) * ly);
  }
  return false;
}

}  // namespace

bool project_to_balanced(const Parameters& p, double* phi) {
  if (p.tilts()) return project_to_tilt_balanced(p, phi);
  std::array<double, max_balls> within{}, turns{};
  for (int i = 0; i < p.balls; ++i) {
    turns[i] = two_pi * std::trunc(phi[i] / two_pi);
    within[i] = phi[i] - turns[i];
  }
  const bool balanced = project_within_a_turn(p, within.data());
  for (int i = 0; i < p.balls; ++i) phi[i] = within[i] + turns[i];
  return balanced;
}

CentredTwin centred_twin(const Parameters& p, double speed) {
  CentredTwin twin{p, 0.0};
  twin.parameters.gravity = 0.0;
  if (p.race_is_centred()) return twin;
  // Forces on a rotor at rest at -e in the rotating frame: f = -(kappa + i zeta psi') e, and psi'^2 times the sum of
  // all unbalances about the axis.
  const std::complex<double> e(p.race_offset[0], p.race_offset[1]);
  const std::complex<double> support(0.5 * (p.stiffness[0] + p.stiffness[1]),
                                     0.5 * (p.damping[0] + p.damping[1]) * speed);
  const std::complex<double> side = p.eccentricity - e + e * support / (speed * speed);
  twin.parameters.race_offset = {0.0, 0.0};
  twin.parameters.eccentricity = std::abs(side);
  twin.turn = std::arg(side);
  return twin;
}

namespace {
// Torque that the supports' dampers absorb in balance, over psi'.
double damping_torque(const Parameters& p) {
  const auto& e = p.race_offset;
  return 0.5 * (p.damping[0] + p.damping[1]) * (e[0] * e[0] + e[1] * e[1]);
}
}  // namespace

std::optional<double> balanced_speed(const System& system) {
  if (system.prescribed()) return system.speed();
  const DriveSegment& m = system.drive().motor;
  const double damping = damping_torque(system.parameters());
  if (m.integral != 0.0)
    return std::fabs(damping * m.aim + m.load(m.aim)) <= m.limit ? std::optional(m.aim) : std::nullopt;
  return m.even_speed(damping);
}

BalancedStates balanced_states(const System& system, double coasting) {
  const std::optional<double> speed = system.coasts() ? std::optional(coasting) : balanced_speed(system);
  BalancedStates none;
  if (!speed)
    none.reason =
        "a balanced rotor needs no torque, and the motor's never vanishes: balanced, it would speed up without end";
  else if (*speed == 0.0 && !(system.prescribed() && system.parameters().race_is_centred()))
    none.reason = "the rotor comes to rest: nothing balances it";
  else if (system.coasts() && !system.parameters().race_is_centred())
    none.reason = "with the race off centre the supports' damping slows a coasting rotor: no speed is held";
  if (!none.reason.empty()) return none;
  const CentredTwin twin = centred_twin(system.parameters(), *speed);
  BalancedStates states = balanced_states(twin.parameters);
  for (auto& phi : states.angles)
    for (int i = 0; i < system.balls(); ++i) phi[i] += twin.turn;
  return states;
}

bool project_to_balanced(const System& system, double speed, double* phi) {
  const CentredTwin twin = centred_twin(system.parameters(), speed);
  for (int i = 0; i < system.balls(); ++i) phi[i] -= twin.turn;
  const bool balanced = project_to_balanced(twin.parameters, phi);
  for (int i = 0; i < system.balls(); ++i) phi[i] += twin.turn;
  return balanced;
}

Eigen::VectorXd balanced_state(const System& system, double speed, const double* phi) {
  const Parameters& p = system.parameters();
  const auto& e = p.race_offset;
  Eigen::VectorXd y = Eigen::VectorXd::Zero(system.dimension());
  if (!p.race_is_centred()) y.head(4) << -e[0], -e[1], speed * e[1], -speed * e[0];
  for (int i = 0; i < p.balls; ++i) y[index::phi(i)] = phi[i];
  if (system.layout().speed >= 0) y[system.layout().speed] = speed;
  // The integral holds the torque that the gain alone would miss.
  const DriveSegment& m = system.drive().motor;
  if (system.layout().error >= 0)
    y[system.layout().error] = (damping_torque(p) * speed + m.load(speed) - m.constant - m.slope * speed) / m.integral;
  return y;
}

double off_balance(const Parameters& p, const Eigen::VectorXd& state) {
  const double away = std::hypot(state[index::x] + p.race_offset[0], state[index::y] + p.race_offset[1]);
  return p.tilts() ? std::hypot(away, state.tail(4).head(2).norm()) : away;
}

int cancelling_freedom(const Parameters& p) {
  return p.tilts() ? tilt_cancelling_freedom(p) : std::max(p.balls - 2, 1);
}

int balanced_freedom(const System& system) {
  constexpr double any_speed = 1.0;
  const Parameters& p = system.parameters();
  if (p.gravity != 0.0 || !(p.race_is_centred() || p.isotropic())) return 0;
  const bool family = balanced_states(system, any_speed).kind == BalancedStates::Kind::continuum;
  return (family ? cancelling_freedom(p) : 0) + (system.coasts() && p.race_is_centred() ? 1 : 0);
}

}  // namespace equipoise::model
