// Newton's method for equilibria: isolated ones and members of continua.
#include <algorithm>
#include <cmath>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

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
