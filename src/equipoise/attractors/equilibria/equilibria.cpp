// Newton's method for equilibria, isolated ones and members of continua; from random ball angles for all of them.
#include "equipoise/attractors/equilibria/equilibria.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/attractors/equilibria/continuum_draws.hpp"
#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/random.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/results/types/motion.hpp"

namespace equipoise {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Refined equilibria are exact to 1e-10; different ones lie further apart, except those just born.
constexpr double same_equilibrium = 1e-6;
// A balanced rotor is centred to rounding.
constexpr double centred_rotor = 1e-9;

// The components of the centre and of the slope, which the equations are linear in while the balls are held.
std::vector<int> rotor_places(const model::System& system) {
  std::vector<int> places{0, 1, 2, 3};
  for (int k = 0; system.tilts() && k < 4; ++k) places.push_back(system.layout().tilt + k);
  return places;
}

// Where the rotor rests with its balls held at the angles of `state`.
void rest_rotor(const model::System& system, VectorXd& state) {
  const std::vector<int> places = rotor_places(system);
  const VectorXd rate = model::rate(system, state);
  const MatrixXd jacobian = model::jacobian(system, state);
  const MatrixXd own = jacobian(places, places);
  const VectorXd rest = rate(places);
  state(places) -= dense::inverse(own) * rest;
}

// A race at rest is on the axis to rounding, and rotors of one continuum rest alike.
constexpr double race_on_axis = 1e-9, rotors_alike = 1e-6;

std::vector<int> free_balls(const model::System& system, const VectorXd& equilibrium) {
  std::vector<int> balls;
  for (int i = 0; i < system.balls(); ++i)
    if (has_free_angle(system, equilibrium, i)) balls.push_back(i);
  return balls;
}

}  // namespace

bool has_free_angle(const model::System& system, const VectorXd& equilibrium, int i) {
  const model::Parameters& p = system.parameters();
  if (!system.tilts() || !system.autonomous() || !system.prescribed()) return false;
  const auto& plane = p.tilt.plane;
  const double z = plane[static_cast<std::size_t>(i)];
  if (std::count(plane.begin(), plane.begin() + p.balls, z) < 3) return false;
  const VectorXd centre = equilibrium.head(2), slope = equilibrium.segment(system.layout().tilt, 2);
  return (centre + z * slope).norm() < race_on_axis && model::off_balance(p, equilibrium) >= race_on_axis;
}

int free_angles(const model::System& system, const VectorXd& equilibrium) {
  return std::max(static_cast<int>(free_balls(system, equilibrium).size()) - 2, 0);
}

ContinuumPart partly_balanced_part(const model::System& system, const VectorXd& equilibrium) {
  constexpr int draws = 256;
  const model::Parameters& p = system.parameters();
  const std::vector<int> balls = free_balls(system, equilibrium);
  model::Parameters race;  // what else its balls have to cancel
  race.balls = static_cast<int>(balls.size());
  std::complex<double> sum;
  for (std::size_t k = 0; k < balls.size(); ++k) {
    race.mass[k] = p.mass[static_cast<std::size_t>(balls[k])];
    sum += std::polar(race.mass[k], equilibrium[model::index::phi(balls[k])]);
  }
  race.eccentricity = std::abs(sum);
  const double turn = std::arg(-sum);
  const int zeros = free_angles(system, equilibrium);
  ContinuumDraws source(race);
  ContinuumPart part;
  std::vector<double> stable, growing;
  std::array<double, model::max_balls> phi{};
  for (; part.drawn < draws && source.next(phi); ++part.drawn) {
    VectorXd member = equilibrium;
    for (std::size_t k = 0; k < balls.size(); ++k) member[model::index::phi(balls[k])] = phi[k] + turn;
    const double largest = slowest_of(dense::eigenvalues(model::jacobian(system, member)), zeros);
    (largest < -zero_eigenvalue ? stable : growing).push_back(largest);
  }
  part.stable = static_cast<int>(stable.size());
  if (!stable.empty()) {
    part.slowest_rate = *std::max_element(stable.begin(), stable.end());
    part.fastest_rate = *std::min_element(stable.begin(), stable.end());
  }
  if (!growing.empty()) {
    part.least_growth = std::max(0.0, *std::min_element(growing.begin(), growing.end()));
    part.most_growth = *std::max_element(growing.begin(), growing.end());
  }
  return part;
}

bool same_continuum(const model::System& system, const VectorXd& a, const VectorXd& b) {
  if (free_angles(system, a) == 0 || free_angles(system, b) == 0) return false;
  const int tilt = system.layout().tilt;
  const double apart = std::hypot((a - b).head(4).norm(), (a - b).segment(tilt, 4).norm());
  return apart < rotors_alike * system.parameters().all_unbalances();
}

std::vector<Equilibrium> unbalanced_equilibria(const model::System& system, int starts, const StopFlag* stop) {
  const StateDifference difference(system);
  RandomStream random;
  std::vector<Equilibrium> found;
  for (int k = 0; k < starts && !is_set(stop); ++k) {
    VectorXd state = VectorXd::Zero(system.dimension());
    for (int i = 0; i < system.balls(); ++i) state[model::index::phi(i)] = two_pi * random.uniform();
    rest_rotor(system, state);
    if (!state.allFinite()) continue;
    std::optional<Equilibrium> e = refine_equilibrium(system, state);
    if (!e || model::off_balance(system.parameters(), e->state) < centred_rotor) continue;
    e->state = system.with_angles_reduced(e->state);
    const auto is_it = [&](const Equilibrium& other) {
      return same_continuum(system, e->state, other.state) ||
             distance_in_any_order(system, difference, e->state, other.state) < same_equilibrium;
    };
    if (std::none_of(found.begin(), found.end(), is_it)) found.push_back(std::move(*e));
  }
  std::stable_sort(found.begin(), found.end(), [](const Equilibrium& a, const Equilibrium& b) {
    return a.eigenvalues[0].real() < b.eigenvalues[0].real();
  });
  return found;
}

namespace {

// Rounding of dz/dt. Its terms are of size speed^2; a motor's terms, which may cancel, are scaled by psi'' per unit of
// torque.
double rounding_of_rates(const model::System& system, const VectorXd& state) {
  const double speed = system.speed(state);
  double size = 1.0 + speed * speed;
  if (!system.prescribed()) {
    const model::DriveSegment& m = system.drive().motor;
    const double error = system.layout().error < 0 ? 0.0 : state[system.layout().error];
    model::DrivePiece idle = system.drive(), pushed = idle;
    idle.motor = {.begin = m.begin, .end = m.end};
    pushed.motor = {.begin = m.begin, .end = m.end, .constant = 1.0};
    const auto acceleration = [&](const model::DrivePiece& drive) {
      const model::System other(system.parameters(), drive);
      return model::rate(other, VectorXd(state.head(other.dimension())))[other.layout().speed];
    };
    size += (std::fabs(m.constant) + std::fabs(m.slope * speed) + std::fabs(m.integral * error) +
             std::fabs(m.bends(speed)) + m.load(std::fabs(speed))) *
            std::fabs(acceleration(pushed) - acceleration(idle));
  }
  return 1e-14 * size;
}

}  // namespace

std::optional<Equilibrium> refine_equilibrium(const model::System& system, const VectorXd& guess) {
  // Levenberg-Marquardt steps with damping |f|^2. They are as fast as Newton's near isolated equilibria and also near
  // continua, where they tend to the least-norm step (N. Yamashita, M. Fukushima, Computing Suppl. 15 (2001) 239).
  constexpr int most_iterations = 100;
  const double target = rounding_of_rates(system, guess);
  VectorXd z = guess, rate = model::rate(system, z);
  for (int iteration = 0; iteration < most_iterations && rate.lpNorm<Eigen::Infinity>() > 0.01 * target; ++iteration) {
    if (!rate.allFinite()) return std::nullopt;
    const MatrixXd jacobian = model::jacobian(system, z);
    MatrixXd normal = jacobian.transpose() * jacobian;
    // Without damping rounding would fill directions in which the Jacobian is singular.
    normal.diagonal().array() += std::max(rate.squaredNorm(), 1e-14 * normal.trace());
    const VectorXd change = -dense::solve_semidefinite(normal, jacobian.transpose() * rate);
    double share = 1.0;
    VectorXd next, next_rate;
    for (; share > 1e-4; share *= 0.5) {
      next = z + share * change;
      next_rate = model::rate(system, next);
      if (next_rate.norm() < rate.norm()) break;
    }
    if (!(share > 1e-4)) break;  // rounding, or no equilibrium nearby
    z = next;
    rate = next_rate;
  }
  Equilibrium result{z, {}, rate.lpNorm<Eigen::Infinity>()};
  if (!(result.residual < target)) return std::nullopt;
  result.eigenvalues = dense::eigenvalues(model::jacobian(system, z));
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
  });
  return result;
}

}  // namespace equipoise
