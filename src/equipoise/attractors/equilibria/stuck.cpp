// Forces on balls that are fixed to the rotor, and bounds on them while the rotor's own motion decays.
#include "equipoise/attractors/equilibria/stuck.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/machine/mechanics/gravity_well.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/attractors/periodic_orbits/event_run-inl.hpp"
#include "equipoise/attractors/periodic_orbits/return_map.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Complex = std::complex<double>;

bool all_rest(const model::System& system, const Eigen::VectorXd& y) {
  const int n = system.balls();
  return (y.segment(model::index::q(0, n), n).array() == 0.0).all();
}

// A rotor at a prescribed speed with fixed balls: a forced linear oscillator on each axis.
class PrescribedEnd {
 public:
  PrescribedEnd(const model::System& system, const Eigen::VectorXd& y)
      : p_(system.parameters()), w_(system.speed()), mass_(1.0 + p_.total_mass()) {
    const Complex u = model::unbalance(p_, y.data() + model::index::phi(0));
    const auto response = [&](int axis) {
      return w_ * w_ * u / Complex(p_.stiffness[axis] - mass_ * w_ * w_, p_.damping[axis] * w_);
    };
    const Complex x = response(0), v = response(1);
    with_ = 0.5 * (x + v);
    against_ = 0.5 * std::conj(x - v);
  }

  // x + i y in the end, and u + i v, its rate in fixed axes.
  Complex place(double psi) const { return with_ + against_ * std::polar(1.0, -2.0 * psi); }
  Complex velocity(double psi) const { return Complex(0.0, w_) * (with_ - against_ * std::polar(1.0, -2.0 * psi)); }
  double r_mean() const { return std::abs(with_); }
  double waver() const { return std::abs(against_); }

  // Whether no ball is torn off at any rotor angle, even if the race accelerates by up to `more` in addition.
  bool holds_all(const Eigen::VectorXd& y, double more) const {
    const double counter = w_ * w_ * std::abs(against_);
    const int looks = counter + p_.gravity > 0.0 ? 128 : 1;
    more += (2.0 * counter + p_.gravity) * pi / looks;  // the most that changes between two looks
    for (int k = 0; k < looks; ++k)
      if (!holds_all(y, more, two_pi * k / looks)) return false;
    return true;
  }

  // The largest acceleration that the rest of the rotor's own motion can still cause. On one axis E = (1+N) v^2 + kappa
  // x^2 falls, so |zeta v + kappa x| <= sqrt(E (zeta^2/(1+N) + kappa)).
  double decaying(const Eigen::VectorXd& y, double psi) const {
    const auto rest = model::rest_position(p_, psi);
    const Complex turn = std::polar(1.0, psi);
    const Complex x = (Complex(y[0] - rest[0], y[1] - rest[1]) - place(psi)) * turn;
    const Complex v = (Complex(y[2], y[3]) - velocity(psi)) * turn;
    const auto bound = [&](int axis, double at, double rate) {
      const double k = p_.stiffness[axis], c = p_.damping[axis];
      return std::sqrt((mass_ * rate * rate + k * at * at) * (c * c / mass_ + k)) / mass_;
    };
    return std::hypot(bound(0, x.real(), v.real()), bound(1, x.imag(), v.imag()));
  }

  double slowest_rate() const {
    double slowest = -1e300;
    for (int axis : {0, 1}) {
      const double half = 0.5 * p_.damping[axis] / mass_, square = half * half - p_.stiffness[axis] / mass_;
      slowest = std::max(slowest, square > 0.0 ? std::sqrt(square) - half : -half);
    }
    return slowest;
  }

 private:
  bool holds_all(const Eigen::VectorXd& y, double more, double psi) const {
    const Complex back = std::polar(1.0, -psi), weight = Complex(0.0, p_.gravity) * back;
    const Complex offset(p_.race_offset[0], p_.race_offset[1]);
    const Complex race = weight - w_ * w_ * (with_ + against_ * back * back + offset);
    for (int i = 0; i < p_.balls; ++i) {
      const Complex along = race * std::polar(1.0, -y[model::index::phi(i)]);
      const double normal = std::fabs(w_ * w_ - along.real()) - more;
      if (!(std::fabs(along.imag()) + more <= p_.stiction[i] * normal)) return false;
    }
    return true;
  }

  const model::Parameters& p_;
  double w_, mass_;
  Complex with_, against_;  // parts that turn with the rotor and against it
};

std::optional<StuckEnd> prescribed_end(const model::System& system, const Eigen::VectorXd& y, double psi) {
  const PrescribedEnd end(system, y);
  if (!end.holds_all(y, end.decaying(y, psi))) return std::nullopt;
  StuckEnd result{y, std::max(0.0, end.r_mean() - end.waver()), end.r_mean(), end.r_mean() + end.waver(),
                  end.slowest_rate()};
  const auto rest = model::rest_position(system.parameters(), 0.0);
  const Complex place = end.place(0.0), velocity = end.velocity(0.0);
  result.state.head(4) << place.real() + rest[0], place.imag() + rest[1], velocity.real(), velocity.imag();
  return result;
}

// Whether the rotor will never turn over again, whatever its balls do.
bool hangs_for_good(const model::System& system, const Eigen::VectorXd& y) {
  const auto well = model::GravityWell::of(system);
  return well && well->holds(y.data());
}

// The same with its balls stuck where they are.
bool hangs_while_stuck(const model::System& system, const Eigen::VectorXd& y) {
  std::array<double, model::machine_layout(1).size> held{};
  model::hold_balls(system, y.data(), held.data());
  return model::trapped_in_well(system, held.data(), std::numeric_limits<double>::infinity());
}

// Around an equilibrium of rotor and motor V = d^T P d falls in the linear flow. A force with gradient g then stays
// within sqrt(g^T P^-1 g V).
std::optional<StuckEnd> driven_end(const model::System& system, const Eigen::VectorXd& y) {
  const bool hangs = hangs_for_good(system, y);
  if (!system.autonomous() && !hangs && !hangs_while_stuck(system, y)) return std::nullopt;
  const auto end = refine_mode_equilibrium(system, y);
  const double slowest = end ? end->eigenvalues[0].real() : 0.0;
  if (!(slowest < 0.0)) return std::nullopt;
  const double r = r_at_rest(system, end->state);
  // Balls that come loose stop again; all such ends are one continuum.
  if (hangs) return StuckEnd{end->state, r, r, r, slowest};
  const int n = system.balls();
  kernels::EventRun run(system, end->state.data(), 0.0, kernels::event_scale(system, 1e-9));
  if (!all_held(run.mode(), n)) return std::nullopt;
  const kernels::ModeEquations equations(system, 0.0, run.mode());
  std::vector<int> free{0, 1, 2, 3};
  for (int i = model::dimension(n); i < system.dimension(); ++i) free.push_back(i);
  const auto size = static_cast<Eigen::Index>(free.size());
  const Eigen::VectorXd scale = system.scale()(free);
  // In natural sizes. Central differences; the equations are good to rounding.
  constexpr double share = 1e-5, safety = 2.0;
  Eigen::MatrixXd a(size, size), gradients(2 * n, size);
  const auto forces = [&](const Eigen::VectorXd& at) {  // friction left to hold each ball, in both senses
    Eigen::VectorXd left(2 * n);
    const auto f = equations.forces(at.data());
    for (int i = 0; i < n; ++i) {
      const double most = system.parameters().stiction[i] * std::fabs(f.normal[i]);
      left[2 * i] = most - f.tangential[i];
      left[2 * i + 1] = most + f.tangential[i];
    }
    return left;
  };
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::VectorXd up = end->state, down = end->state, rate_up(up.size()), rate_down(up.size());
    up[free[k]] += share * scale[k];
    down[free[k]] -= share * scale[k];
    equations(0.0, up.data(), rate_up.data());
    equations(0.0, down.data(), rate_down.data());
    a.col(k) = ((rate_up - rate_down)(free)).cwiseQuotient(scale) / (2.0 * share);
    gradients.col(k) = (forces(up) - forces(down)) / (2.0 * share);
  }
  const Eigen::MatrixXd p = solve_lyapunov(a, Eigen::MatrixXd::Identity(size, size));
  const Eigen::VectorXd d = ((y - end->state)(free)).cwiseQuotient(scale), left = forces(end->state);
  const double v = d.dot(p * d);
  if (!(v >= 0.0)) return std::nullopt;
  const Eigen::MatrixXd inverse = dense::inverse(p);
  for (Eigen::Index k = 0; k < 2 * n; ++k)
    if (!(safety * std::sqrt(gradients.row(k).dot(gradients.row(k) * inverse) * v) < left[k])) return std::nullopt;
  return StuckEnd{end->state, r, r, r, slowest};
}

}  // namespace

double bare_response(const model::Parameters& p, double speed) {
  const double stiffness = 0.5 * (p.stiffness[0] + p.stiffness[1]), damping = 0.5 * (p.damping[0] + p.damping[1]);
  return p.eccentricity * speed * speed / std::hypot(stiffness - speed * speed, damping * speed);
}

bool halves_the_shaking(const model::Parameters& p, double speed, double r) {
  constexpr double rounding = 1e-6;  // for a rotor without unbalance of its own
  constexpr double standing = 1e-3;  // a rotor that hardly turns cannot be balanced
  return std::fabs(speed) > standing && r <= std::max(0.5 * bare_response(p, speed), rounding);
}

std::optional<StuckEnd> stuck_for_good(const model::System& system, const Eigen::VectorXd& state, double psi) {
  if (!system.events().stick || !all_rest(system, state)) return std::nullopt;
  return system.prescribed() ? prescribed_end(system, state, psi) : driven_end(system, state);
}

Motion describe_stuck(const model::System& system, const StuckEnd& end) {
  Motion motion = motion_at_rest(system, {end.state, {}, 0.0});
  motion.stuck = motion.eventful = motion.set_valued = motion.stable = true;
  motion.depends_on_angle = !system.autonomous();
  motion.exponents = {end.slowest_rate};
  motion.r_min = end.r_min;
  motion.r_mean = end.r_mean;
  motion.r_max = end.r_max;
  motion.balanced = halves_the_shaking(system.parameters(), motion.speed, end.r_mean);
  motion.mode = mode_at(system, motion.state);
  std::fill_n(motion.mode.held.begin(), system.balls(), true);
  return motion;
}

}  // namespace equipoise
