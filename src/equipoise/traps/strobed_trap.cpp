// Quadratic forms along strobed orbits.
#include "equipoise/traps/strobed_trap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <utility>

#include "equipoise/base/angles.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/math/lyapunov.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/unbalance.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double tolerance = 1e-12;
// Cells a strobe: cubic interpolation between nodes 0.1 to 0.2 rad of the rotor apart errs by 1e-6 of an amplitude or
// less, far below any trap's size.
constexpr int cells_a_strobe = 32;
// Share of the slowest rate that the form's decay is asked to reach: nearer to 1 it would be all slow directions.
constexpr double share_of_rate = 0.8;

// The places on the orbit that equal balls of a state are nearest to, one after the other.
VectorXd in_places(const model::Parameters& p, const VectorXd& orbit, const double* state) {
  const int n = p.balls;
  VectorXd result = Eigen::Map<const VectorXd>(state, orbit.size());
  if (!p.equal_balls() || n == 1) return result;
  std::array<bool, model::max_balls> taken{};
  for (int i = 0; i < n; ++i) {
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
      if (taken[k]) continue;
      const double away = std::fabs(wrapped(state[model::index::phi(k)] - orbit[model::index::phi(i)])) +
                          std::fabs(state[model::index::q(k, n)] - orbit[model::index::q(i, n)]);
      if (away < least) {
        least = away;
        nearest = k;
      }
    }
    taken[nearest] = true;
    result[model::index::phi(i)] = state[model::index::phi(nearest)];
    result[model::index::q(i, n)] = state[model::index::q(nearest, n)];
  }
  return result;
}

}  // namespace

double slowest_strobed_rate(const Motion& motion) {
  const double duration = motion.orbit.period;
  return std::log(std::max(1e-300, std::abs(motion.orbit.multipliers[0]))) / duration;
}

std::optional<StrobedTrap> strobed_trap(const model::Parameters& p, double speed, const Motion& motion, int attractor) {
  if (!motion.stable || motion.orbit.nodes.empty()) return std::nullopt;
  StrobedTrap trap;
  trap.attractor = attractor;
  trap.strobes = static_cast<int>(motion.orbit.nodes.size());
  trap.cells = cells_a_strobe;
  const double strobe = model::strobe_period(p, speed), h = strobe / trap.cells;
  const double step_angle = model::strobe_angle(p) / trap.cells * (speed < 0.0 ? -1.0 : 1.0);
  const VectorXd unit = model::state_scale(p);
  std::vector<MatrixXd> arcs;
  for (const VectorXd& node : motion.orbit.nodes) {
    VectorXd z = node;
    for (int k = 0; k < trap.cells; ++k) {
      const double psi = step_angle * k;
      trap.states.push_back(z);
      trap.rates.push_back(model::derivative(p, speed, z.data(), psi));
      auto arc = follow_derivative({p, speed}, z, h, tolerance, psi);
      if (!arc) return std::nullopt;
      arcs.push_back(unit.cwiseInverse().asDiagonal() * arc->tangents * unit.asDiagonal());
      z = std::move(arc->end);
    }
  }
  trap.states.push_back(trap.states.front());
  for (int i = 0; i < p.balls; ++i) trap.states.back()[model::index::phi(i)] += two_pi * motion.orbit.winding[i];
  trap.rates.push_back(trap.rates.front());

  const double growth = std::exp(-share_of_rate * slowest_strobed_rate(motion) * h);
  const Index size = unit.size();
  MatrixXd all = MatrixXd::Identity(size, size), once = MatrixXd::Zero(size, size);
  for (const MatrixXd& arc : arcs) all = growth * arc * all;
  for (auto arc = arcs.rbegin(); arc != arcs.rend(); ++arc)
    once = h * MatrixXd::Identity(size, size) + growth * growth * arc->transpose() * once * *arc;
  auto form = solve_stein(all, once);
  if (!form) return std::nullopt;
  trap.forms.assign(arcs.size() + 1, *form);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = arcs.size(); k-- > 0;) {
    trap.forms[k] =
        h * MatrixXd::Identity(size, size) + growth * growth * arcs[k].transpose() * trap.forms[k + 1] * arcs[k];
    least = std::min(least, dense::symmetric_eigenvalues(trap.forms[k]).minCoeff());
  }
  if (!(least > 0.0)) return std::nullopt;
  for (MatrixXd& f : trap.forms) f /= least;
  return trap;
}

double strobed_value(const model::Parameters& p, double speed, const StrobedTrap& trap, const double* state,
                     double psi) {
  const double angle = model::strobe_angle(p);
  double turned = std::fmod(speed < 0.0 ? -psi : psi, angle);
  if (turned < 0.0) turned += angle;
  const double place = turned / angle * trap.cells;
  const int cell = std::min(static_cast<int>(place), trap.cells - 1);
  const double s = place - cell, r = 1.0 - s;
  const double h = model::strobe_period(p, speed) / trap.cells;
  const VectorXd unit = model::state_scale(p);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < trap.strobes; ++k) {
    const std::size_t j = static_cast<std::size_t>(k * trap.cells + cell);
    const VectorXd orbit = r * r * (1.0 + 2.0 * s) * trap.states[j] + s * s * (3.0 - 2.0 * s) * trap.states[j + 1] +
                           h * s * r * (r * trap.rates[j] - s * trap.rates[j + 1]);
    VectorXd d = in_places(p, orbit, state) - orbit;
    for (int i = 0; i < p.balls; ++i) d[model::index::phi(i)] = wrapped(d[model::index::phi(i)]);
    d = d.cwiseQuotient(unit);
    // V is |d|^2 or more: what is far off need not be weighed.
    const double square = d.squaredNorm();
    if (square > least || (trap.level > 0.0 && square > trap.level)) continue;
    least = std::min(least, r * d.dot(trap.forms[j] * d) + s * d.dot(trap.forms[j + 1] * d));
  }
  return least;
}

VectorXd strobed_trap_state(const model::Parameters& p, const StrobedTrap& trap, int row, double level,
                            const VectorXd& direction) {
  const std::size_t j = static_cast<std::size_t>(row);
  const VectorXd d = std::sqrt(level) * dense::Cholesky(trap.forms[j]).solve_upper(direction);
  return trap.states[j] + model::state_scale(p).cwiseProduct(d);
}

StrobedFamilyTest strobed_family_test(const model::Parameters& p, double speed, ContinuumTrap trap) {
  return [p, speed, trap = std::move(trap)](const double* state, double psi) {
    const int n = p.balls;
    double away = std::abs(model::unbalance(p, state + model::index::phi(0)));
    for (int i = 0; i < n; ++i) away = std::max(away, std::fabs(state[model::index::q(i, n)]));
    for (int i = 0; i < 4; ++i) away = std::max(away, std::fabs(state[i]));
    if (!(away < trap.reach)) return false;
    const Index size = model::dimension(n);
    const auto at_strobe = at_next_strobe({p, speed}, Eigen::Map<const VectorXd>(state, size), psi);
    return at_strobe && trap.holds(*at_strobe);
  };
}

StrobedTraps traps_as_rule(const model::Parameters& p, double speed,
                           const std::vector<std::shared_ptr<const StrobedTrap>>& traps,
                           const StrobedFamilyTest& family) {
  if (traps.empty() && !family) return {};
  return {[p, speed, traps, family](const double* state, double psi) {
    for (const auto& trap : traps)
      if (strobed_value(p, speed, *trap, state, psi) < trap->level) return trap->attractor;
    return family && family(state, psi) ? balanced_id : 0;
  }};
}

}  // namespace equipoise
