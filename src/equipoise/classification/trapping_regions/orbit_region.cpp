// How deep a state lies inside an orbit's trapping region. Lanes compare states with a ball's angle at every step:
// their table has many cells, with a chord and one form each. With the rotor's angle as phase, states are tested one by
// one and seldom: a few cells with cubics in between suffice.
#include "equipoise/classification/trapping_regions/orbit_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/simulation/rule/region_values-inl.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/hermite.hpp"
#include "equipoise/machine/model/ball_count.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Components that are compared with the table: all except the phase, if the state contains it.
Eigen::VectorXi compared(const OrbitRegion& region) {
  const int size = static_cast<int>(region.unit.size());
  if (region.phase_place < 0) return Eigen::VectorXi::LinSpaced(size, 0, size - 1);
  Eigen::VectorXi others(size - 1);
  for (int i = 0, k = 0; i < size; ++i)
    if (i != region.phase_place) others[k++] = i;
  return others;
}

// The form of compared components where a row's cell begins.
MatrixXd form_at(const OrbitRegion& region, int row) {
  const MatrixXd& form = region.nodes[row].form;
  if (region.clock == OrbitRegion::rotor) return form;
  const Eigen::VectorXi others = compared(region);
  return 0.5 * (form(others, others) + region.nodes[row + 1].form(others, others));
}

// Puts alike balls of a state, one after the other, in the nearest free place on the motion.
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

double value_by_rotor(const model::System& system, const OrbitRegion& region, const double* state, double psi) {
  const double angle = system.section_angle();
  const bool driven = region.phase_place >= 0;
  if (driven) psi = state[region.phase_place];
  const double sense =
      driven ? region.nodes[1].state[region.phase_place] - region.nodes[0].state[region.phase_place] : system.speed();
  double turned = std::fmod(sense < 0.0 ? -psi : psi, angle);
  if (turned < 0.0) turned += angle;
  const double place = turned / angle * region.cells;
  const int cell = std::min(static_cast<int>(place), region.cells - 1);
  const double s = place - cell, r = 1.0 - s;
  const double h = (driven ? angle : system.section_period()) / region.cells;  // the unit of rates
  const Eigen::VectorXi compare = compared(region);
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < region.turns; ++turn) {
    const OrbitRegion::Node &a = region.nodes[turn * region.cells + cell],
                            &b = region.nodes[turn * region.cells + cell + 1];
    const VectorXd motion = hermite(s, h, a.state, a.rate, b.state, b.rate);
    VectorXd d = in_places(system, motion, state) - motion;
    for (int i = 0; i < system.balls(); ++i) d[model::index::phi(i)] = wrapped(d[model::index::phi(i)]);
    d = d.cwiseQuotient(region.unit)(compare).eval();
    // V is |d|^2 or more, so far-off states need no form.
    const double square = d.squaredNorm();
    if (square > least || (region.level > 0.0 && square > region.level)) continue;
    least = std::min(least, r * d.dot(a.form * d) + s * d.dot(b.form * d));
  }
  return least;
}

}  // namespace

double value(const model::System& system, const OrbitRegion& region, const double* state, double psi) {
  if (region.clock == OrbitRegion::rotor) return value_by_rotor(system, region, state, psi);
  const model::BallCount<model::any_count> count(system.balls());
  return kernels::orbit_region_value(table_of(region, system.balls()), count, system.dimension(), state);
}

int directions(const OrbitRegion& region) { return static_cast<int>(compared(region).size()); }

VectorXd state_on_level(const OrbitRegion& region, int row, double level, const VectorXd& direction) {
  const Eigen::VectorXi others = compared(region);
  const VectorXd d = std::sqrt(level) * dense::Cholesky(form_at(region, row)).solve_upper(direction);
  VectorXd state = region.nodes[row].state;
  for (Eigen::Index k = 0; k < d.size(); ++k) state[others[k]] += region.unit[others[k]] * d[k];
  return state;
}

bool is_definite(const OrbitRegion& region) {
  for (int row = 0; row < region.rows(); ++row)
    if (!dense::Cholesky(form_at(region, row)).definite()) return false;
  return true;
}

OrbitRegion exchanged(const OrbitRegion& region, int balls, const BallOrder& order) {
  const Eigen::VectorXi from = exchanged_components(balls, order, region.unit.size());
  OrbitRegion result = region;
  if (region.clock != OrbitRegion::rotor) {
    result.clock = static_cast<int>(std::find(order.begin(), order.begin() + balls, region.clock) - order.begin());
    result.phase_place = model::index::phi(result.clock);
  }
  result.unit = region.unit(from);
  for (OrbitRegion::Node& node : result.nodes) {
    node.state = node.state(from).eval();
    if (node.rate.size() > 0) node.rate = node.rate(from).eval();
    node.form = node.form(from, from).eval();
  }
  return result;
}

OrbitRegionTable table_of(const OrbitRegion& region, int balls) {
  const Eigen::VectorXi compare = compared(region);
  const Eigen::Index others = compare.size();
  OrbitRegionTable table;
  table.attractor = region.attractor;
  table.clock = region.clock;
  table.turns = region.turns;
  table.cells = region.cells;
  table.level = region.level;
  table.q_low.fill(1e300);
  table.q_high.fill(-1e300);
  double r_low = 1e300, r_high = 0.0;
  for (int row = 0; row < region.rows(); ++row) {
    const VectorXd place = region.nodes[row].state(compare);
    const VectorXd change = region.nodes[row + 1].state(compare) - place;
    const MatrixXd factor = dense::Cholesky(form_at(region, row)).upper();
    table.table.insert(table.table.end(), place.begin(), place.end());
    table.table.insert(table.table.end(), change.begin(), change.end());
    for (Eigen::Index i = 0; i < others; ++i)
      for (Eigen::Index l = i; l < others; ++l) table.table.push_back(factor(i, l));
    // The form's reach in each variable, and one reach in the plane of the rotor's centre for all directions.
    const MatrixXd inverse = dense::inverse(factor);
    const VectorXd reach = (region.level * (inverse * inverse.transpose()).diagonal()).cwiseSqrt();
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
