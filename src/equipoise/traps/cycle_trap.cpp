// How deep inside a cycle's trap a state lies. There are two ways to look between the rows of a table: lanes, which
// compare states with a ball's angle at every step, take chords and one form a cell, of many cells; with the rotor's
// angle states are asked one by one, and seldom, so that few cells, cubic in between, do.
#include "equipoise/traps/cycle_trap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "equipoise/base/angles.hpp"
#include "equipoise/deciding/traps-inl.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/math/hermite.hpp"
#include "equipoise/model/ball_count.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Components that are compared with the table: all but the phase, where that is one of them.
Eigen::VectorXi compared(const CycleTrap& trap) {
  const int size = static_cast<int>(trap.unit.size());
  if (trap.phase_place < 0) return Eigen::VectorXi::LinSpaced(size, 0, size - 1);
  Eigen::VectorXi others(size - 1);
  for (int i = 0, k = 0; i < size; ++i)
    if (i != trap.phase_place) others[k++] = i;
  return others;
}

// The form of compared components where a row's cell begins.
MatrixXd form_at(const CycleTrap& trap, int row) {
  const MatrixXd& form = trap.nodes[row].form;
  if (trap.clock == CycleTrap::rotor) return form;
  const Eigen::VectorXi others = compared(trap);
  return 0.5 * (form(others, others) + trap.nodes[row + 1].form(others, others));
}

// The places on the motion that like balls of a state are nearest to, one after the other.
VectorXd in_places(const model::System& system, const VectorXd& motion, const double* state) {
  const int n = system.balls();
  BallOrder order{};
  std::array<bool, model::max_balls> taken{};
  for (int i = 0; i < n; ++i) {
    int nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < n; ++k) {
      if (taken[k] || !system.alike(i, k)) continue;
      const double away = std::fabs(wrapped(state[model::index::phi(k)] - motion[model::index::phi(i)])) +
                          std::fabs(state[model::index::q(k, n)] - motion[model::index::q(i, n)]);
      if (nearest < 0 || away < least) {
        least = away;
        nearest = k;
      }
    }
    taken[nearest] = true;
    order[i] = nearest;
  }
  return Eigen::Map<const VectorXd>(state, motion.size())(exchanged_components(n, order, motion.size()));
}

double value_by_rotor(const model::System& system, const CycleTrap& trap, const double* state, double psi) {
  const double angle = system.strobe_angle();
  const bool driven = trap.phase_place >= 0;
  if (driven) psi = state[trap.phase_place];
  const double sense =
      driven ? trap.nodes[1].state[trap.phase_place] - trap.nodes[0].state[trap.phase_place] : system.speed();
  double turned = std::fmod(sense < 0.0 ? -psi : psi, angle);
  if (turned < 0.0) turned += angle;
  const double place = turned / angle * trap.cells;
  const int cell = std::min(static_cast<int>(place), trap.cells - 1);
  const double s = place - cell, r = 1.0 - s;
  const double h = (driven ? angle : system.strobe_period()) / trap.cells;  // in what rates are by
  const Eigen::VectorXi compare = compared(trap);
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < trap.turns; ++turn) {
    const CycleTrap::Node &a = trap.nodes[turn * trap.cells + cell], &b = trap.nodes[turn * trap.cells + cell + 1];
    const VectorXd motion = hermite(s, h, a.state, a.rate, b.state, b.rate);
    VectorXd d = in_places(system, motion, state) - motion;
    for (int i = 0; i < system.balls(); ++i) d[model::index::phi(i)] = wrapped(d[model::index::phi(i)]);
    d = d.cwiseQuotient(trap.unit)(compare).eval();
    // V is |d|^2 or more: what is far off need not be weighed.
    const double square = d.squaredNorm();
    if (square > least || (trap.level > 0.0 && square > trap.level)) continue;
    least = std::min(least, r * d.dot(a.form * d) + s * d.dot(b.form * d));
  }
  return least;
}

}  // namespace

double value(const model::System& system, const CycleTrap& trap, const double* state, double psi) {
  if (trap.clock == CycleTrap::rotor) return value_by_rotor(system, trap, state, psi);
  const model::BallCount<model::any_count> count(system.balls());
  return kernels::trap_value(table_of(trap, system.balls()), count, system.dimension(), state);
}

int directions(const CycleTrap& trap) { return static_cast<int>(compared(trap).size()); }

VectorXd state_on_level(const CycleTrap& trap, int row, double level, const VectorXd& direction) {
  const Eigen::VectorXi others = compared(trap);
  const VectorXd d = std::sqrt(level) * dense::Cholesky(form_at(trap, row)).solve_upper(direction);
  VectorXd state = trap.nodes[row].state;
  for (Eigen::Index k = 0; k < d.size(); ++k) state[others[k]] += trap.unit[others[k]] * d[k];
  return state;
}

bool is_definite(const CycleTrap& trap) {
  for (int row = 0; row < trap.rows(); ++row)
    if (!dense::Cholesky(form_at(trap, row)).definite()) return false;
  return true;
}

CycleTrap exchanged(const CycleTrap& trap, int balls, const BallOrder& order) {
  const Eigen::VectorXi from = exchanged_components(balls, order, trap.unit.size());
  CycleTrap result = trap;
  if (trap.clock != CycleTrap::rotor) {
    result.clock = static_cast<int>(std::find(order.begin(), order.begin() + balls, trap.clock) - order.begin());
    result.phase_place = model::index::phi(result.clock);
  }
  result.unit = trap.unit(from);
  for (CycleTrap::Node& node : result.nodes) {
    node.state = node.state(from).eval();
    if (node.rate.size() > 0) node.rate = node.rate(from).eval();
    node.form = node.form(from, from).eval();
  }
  return result;
}

CycleTable table_of(const CycleTrap& trap, int balls) {
  const Eigen::VectorXi compare = compared(trap);
  const Eigen::Index others = compare.size();
  CycleTable table;
  table.attractor = trap.attractor;
  table.clock = trap.clock;
  table.turns = trap.turns;
  table.cells = trap.cells;
  table.level = trap.level;
  table.q_low.fill(1e300);
  table.q_high.fill(-1e300);
  double r_low = 1e300, r_high = 0.0;
  for (int row = 0; row < trap.rows(); ++row) {
    const VectorXd place = trap.nodes[row].state(compare);
    const VectorXd change = trap.nodes[row + 1].state(compare) - place;
    const MatrixXd factor = dense::Cholesky(form_at(trap, row)).upper();
    table.table.insert(table.table.end(), place.begin(), place.end());
    table.table.insert(table.table.end(), change.begin(), change.end());
    for (Eigen::Index i = 0; i < others; ++i)
      for (Eigen::Index l = i; l < others; ++l) table.table.push_back(factor(i, l));
    // The quadratic form's reach in each variable, and one in the plane of the rotor's centre that covers every way.
    const MatrixXd inverse = dense::inverse(factor);
    const VectorXd reach = (trap.level * (inverse * inverse.transpose()).diagonal()).cwiseSqrt();
    const double around = std::hypot(reach[0], reach[1]);
    for (const double f : {0.0, 1.0}) {
      const double r = std::hypot(place[0] + f * change[0], place[1] + f * change[1]);
      r_low = std::min(r_low, r - around - std::hypot(change[0], change[1]));
      r_high = std::max(r_high, r + around);
      for (int i = 0; i < balls; ++i) {
        const Eigen::Index k = model::index::q(i, balls) - 1;
        table.q_low[i] = std::min(table.q_low[i], place[k] + f * change[k] - reach[k]);
        table.q_high[i] = std::max(table.q_high[i], place[k] + f * change[k] + reach[k]);
      }
    }
  }
  table.r2_low = r_low > 0.0 ? r_low * r_low : -1.0;
  table.r2_high = r_high * r_high;
  return table;
}

}  // namespace equipoise
