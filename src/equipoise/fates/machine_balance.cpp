// Balanced states of machines: where, how stable, and who comes to them.
#include "equipoise/fates/machine_balance.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "equipoise/base/angles.hpp"
#include "equipoise/base/random.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/math/lyapunov.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/strobe.hpp"

namespace equipoise {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Rates below this are zero to the errors of an eigenvalue computation.
constexpr double no_rate = 1e-8;

// Lengths and velocities of the rotor count in units of all unbalances together, like the errors of a step.
VectorXd scaled(const model::FreeMachine& machine, VectorXd d) {
  const double unit = machine.parameters().all_unbalances();
  d.head(4) /= unit;
  return d;
}

// Rates of decay of all directions but the `free` slowest ones: of eigenvalues of a flow, or of logarithms of
// multipliers.
LinearBalance slowest_of(std::vector<double> growth, std::vector<double> sizes, int free) {
  std::vector<std::size_t> order(growth.size());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] < sizes[b]; });
  double largest = -1e300;
  for (std::size_t k = static_cast<std::size_t>(free); k < order.size(); ++k)
    largest = std::max(largest, growth[order[k]]);
  return {-largest};
}

// The linear flow over one strobe around a state that does not move.
MatrixXd monodromy(const model::FreeMachine& machine, const VectorXd& y) {
  const double angle = model::strobe_angle(machine.parameters());
  const double speed = machine.speed(y), time = angle / std::fabs(speed);
  // Fourth order; errors of (rate h)^5 a step with h at most a hundredth of the supports' period and of the strobe.
  const int steps = std::max(100, static_cast<int>(std::ceil(time * 20.0)));
  const double h = time / steps, turn = (speed > 0.0 ? angle : -angle) / steps;
  MatrixXd m = MatrixXd::Identity(y.size(), y.size());
  MatrixXd a = machine.jacobian(y, 0.0);
  for (int k = 0; k < steps; ++k) {
    const MatrixXd middle = machine.jacobian(y, turn * (k + 0.5)), end = machine.jacobian(y, turn * (k + 1));
    const MatrixXd k1 = a * m, k2 = middle * (m + 0.5 * h * k1), k3 = middle * (m + 0.5 * h * k2),
                   k4 = end * (m + h * k3);
    m += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    a = end;
  }
  return m;
}

}  // namespace

bool LinearBalance::stable() const { return rate > no_rate; }

LinearBalance linear_balance(const MatrixXd& a, int free) {
  const Eigen::VectorXcd values = dense::eigenvalues(a);
  std::vector<double> growth, sizes;
  for (const std::complex<double>& v : values) {
    growth.push_back(v.real());
    sizes.push_back(std::abs(v));
  }
  return slowest_of(growth, sizes, free);
}

MachineBalance::MachineBalance(const model::Parameters& p, const model::DrivePiece& last)
    : machine_(p, last), states_(model::balanced_states(p)) {
  if (states_.kind == model::BalancedStates::Kind::none)
    reason_ = "no balanced state exists: " + states_.reason;
  else if (!p.race_is_centred())
    reason_ = "a race off the shaft's centre keeps the rotor from exact balance";
  else if (!machine_.balanced_speed() && !machine_.coasts())
    reason_ = model::no_speed_is_held;
  exists_ = reason_.empty();
}

int MachineBalance::free_directions() const {
  const int family =
      states_.kind == model::BalancedStates::Kind::family ? std::max(machine_.parameters().balls - 2, 1) : 0;
  return family + (machine_.coasts() ? 1 : 0);
}

std::optional<VectorXd> MachineBalance::nearest(const double* z) const {
  const model::Parameters& p = machine_.parameters();
  double phi[model::max_balls];
  for (int i = 0; i < p.balls; ++i) phi[i] = z[model::index::phi(i)];
  if (!model::project_to_balanced(p, phi)) return std::nullopt;
  const double speed = machine_.balanced_speed().value_or(z[model::machine_index::speed(p.balls)]);
  return machine_.balanced_state(phi, speed);
}

LinearBalance MachineBalance::linearised(const VectorXd& balanced) const {
  const double speed = machine_.speed(balanced);
  if (machine_.parameters().isotropic()) return linear_balance(machine_.jacobian(balanced), free_directions());
  if (speed == 0.0) return {};
  const double time = model::strobe_period(machine_.parameters(), speed);
  const Eigen::VectorXcd values = dense::eigenvalues(monodromy(machine_, balanced));
  std::vector<double> growth, sizes;
  for (const std::complex<double>& v : values) {
    growth.push_back(std::log(std::max(1e-300, std::abs(v))) / time);
    sizes.push_back(std::abs(v - 1.0));
  }
  return slowest_of(growth, sizes, free_directions());
}

double MachineBalance::distance(const double* z, const VectorXd& balanced) const {
  VectorXd d = scaled(machine_, machine_.reduced(z) - balanced);
  if (!machine_.driven()) return d.norm();
  // A speed counts as a share of the speed that it comes to, and little: balance is balance at any speed, and a weak
  // motor takes its time. Not so where an integral of the speed's error still has torque to give.
  constexpr double of_speed = 0.02;
  const int place = machine_.speed_place();
  const bool with_integral = machine_.size() > place + 1;
  d[place] *= (with_integral ? 1.0 : of_speed) / std::max(1.0, std::fabs(balanced[place]));
  // The integral itself has no size of its own: its torque tells in psi'.
  if (with_integral) d[machine_.size() - 1] = 0.0;
  return d.norm();
}

bool MachineBalance::stable_now(const double* z, const VectorXd& balanced) const {
  double phi[model::max_balls];
  for (int i = 0; i < machine_.parameters().balls; ++i) phi[i] = balanced[model::index::phi(i)];
  return linearised(machine_.balanced_state(phi, z[model::machine_index::speed(machine_.parameters().balls)])).stable();
}

// Whether any two balls come nearer to touching there than four times as far as z is away.
bool MachineBalance::may_touch(const double* z, const VectorXd& balanced) const {
  const model::Parameters& p = machine_.parameters();
  if (!p.balls_collide()) return false;
  const double room = p.contact_angle + 4.0 * distance(z, balanced);
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (std::fabs(wrapped(balanced[model::index::phi(i)] - balanced[model::index::phi(k)])) < room) return true;
  return false;
}

bool MachineBalance::holds(const double* z, const VectorXd& balanced) const {
  if (!machine_.parameters().isotropic() || may_touch(z, balanced)) return false;
  const double unit = machine_.parameters().all_unbalances();
  const Eigen::Index size = balanced.size(), across = size - free_directions();
  VectorXd units = VectorXd::Ones(size);
  units.head(4).fill(unit);
  const MatrixXd a = units.cwiseInverse().asDiagonal() * machine_.jacobian(balanced) * units.asDiagonal();
  // The spectral projection across the free directions: left null vectors tell what part of a deviation lies along.
  const dense::Svd svd = dense::svd(a);
  const MatrixXd range = svd.u.leftCols(across), along = svd.v.rightCols(size - across),
                 left = svd.u.rightCols(size - across);
  MatrixXd project = MatrixXd::Identity(size, size);
  if (across < size) project -= along * dense::inverse(MatrixXd(left.transpose() * along)) * left.transpose();
  const MatrixXd down = range.transpose() * project, reduced = range.transpose() * a * range;
  const double slowest = linear_balance(reduced, 0).rate;
  if (!(slowest > no_rate)) return false;
  // Falls at least as fast as 0.8 of the slowest mode in every direction.
  const MatrixXd shifted = reduced + 0.8 * slowest * MatrixXd::Identity(across, across);
  const MatrixXd form = solve_lyapunov(shifted, MatrixXd::Identity(across, across));
  const VectorXd own = down * ((machine_.reduced(z) - balanced).cwiseQuotient(units));
  const double level = own.dot(form * own);
  const dense::Cholesky factor(form);
  if (!(level > 0.0) || !factor.definite()) return false;
  RandomStream random;
  constexpr int directions = 96;
  for (int k = 0; k < directions; ++k) {
    // Evenly over the ellipsoid's own sphere, so that its long axes are among what is tried.
    VectorXd s(across);
    for (Eigen::Index i = 0; i < across; ++i) s[i] = random.normal();
    s = factor.solve_upper(VectorXd(s / s.norm()));
    if (k == 0) s = own / std::sqrt(level);
    s *= 2.0 * std::sqrt(level);
    const VectorXd there = balanced + (range * s).cwiseProduct(units);
    const VectorXd rate = down * machine_.rate(there).cwiseQuotient(units);
    if (!(s.dot(form * rate) < 0.0)) return false;
  }
  return true;
}

std::optional<VectorXd> rest_state(const model::FreeMachine& machine, const VectorXd& start, double reach) {
  const double unit = machine.parameters().all_unbalances();
  VectorXd units = VectorXd::Ones(start.size());
  units.head(4).fill(unit);
  VectorXd y = start;
  for (int iteration = 0; iteration < 30; ++iteration) {
    const VectorXd rate = machine.rate(y).cwiseQuotient(units);
    if (rate.norm() < 1e-12) return y;
    const MatrixXd a = units.cwiseInverse().asDiagonal() * machine.jacobian(y) * units.asDiagonal();
    const dense::Svd svd = dense::svd(a);
    VectorXd step = VectorXd::Zero(y.size());
    for (Eigen::Index k = 0; k < y.size(); ++k)
      if (svd.values[k] > 1e-9 * svd.values[0]) step -= svd.v.col(k) * (svd.u.col(k).dot(rate) / svd.values[k]);
    y += step.cwiseProduct(units);
    if (!((y - start).cwiseQuotient(units).norm() < reach)) return std::nullopt;
    // Rounding of forces of the size of all unbalances may leave a little more than asked.
    if (step.norm() < 1e-13) return y;
  }
  return std::nullopt;
}

void BalanceApproach::begin(double t, const VectorXd& balanced) {
  near_ = true;
  reference_ = balanced;
  linear_ = balance_.linearised(balanced);
  unstable_ = !linear_.stable();
  first_time_ = t;
  first_distance_ = distance_;
  tried_ = 1e300;
}

BalanceApproach::Verdict BalanceApproach::look(double t, const double* z) {
  // Farther off, linear theory has nothing to say; a thousandth off, and having come as promised, it has.
  // Floquet's theory costs as much as a hundred time units, and is asked later.
  const double in_reach = balance_.machine().parameters().isotropic() ? 0.2 : 0.02;
  constexpr double reached = 1e-3, moved = 0.05, nothing_left = 1e-7;
  distance_ = 1e300;
  if (!balance_.exists()) return Verdict::none;
  const auto balanced = balance_.nearest(z);
  if (balanced) distance_ = balance_.distance(z, *balanced);
  if (!(distance_ < in_reach)) {
    near_ = unstable_ = false;
    return Verdict::none;
  }
  // Anew where the trajectory has moved on along a continuum, or away.
  if (!near_ || (*balanced - reference_).cwiseAbs().maxCoeff() > moved || distance_ > first_distance_)
    begin(t, *balanced);
  if (unstable_) return Verdict::none;
  if (distance_ < nothing_left) return Verdict::arriving;
  const double shrunk = std::log(first_distance_ / distance_), promised = linear_.rate * (t - first_time_);
  if (distance_ < reached && shrunk > 2.0 && shrunk > 0.5 * promised && balance_.stable_now(z, *balanced))
    return Verdict::arriving;
  if (distance_ < 0.5 * tried_) {
    tried_ = distance_;
    if (balance_.holds(z, *balanced)) return Verdict::held;
  }
  return Verdict::none;
}

}  // namespace equipoise
