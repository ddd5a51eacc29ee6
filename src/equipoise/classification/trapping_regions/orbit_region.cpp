// How deep a state lies inside an orbit's trapping region. Lanes compare states with a ball's angle at every step:
// their table has many cells, with a chord and one form each. With the rotor's angle as phase, states are tested one by
// one and seldom: a few cells with cubics in between suffice.
//
// Two kinds of forms. Along a motion with a free period nothing brings a deviation back, so the form is made of Floquet
// vectors, which have no part along it; the phase may be any angle that grows. On a stroboscopic section the phase is
// imposed and every deviation shrinks, so the form integrates its square along the linear flow. That needs no
// eigenvectors, which double precision cannot separate if multipliers span many powers of ten (drag).
#include "equipoise/classification/trapping_regions/orbit_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/simulation/rule/region_values-inl.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/hermite.hpp"
#include "equipoise/machine/model/ball_count.hpp"

namespace equipoise {

namespace {

namespace kernels = HWY_NAMESPACE;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Node = OrbitRegion::Node;

// For a ball, with chords: a chord misses its arc by (2 pi / 128)^2 / 8 = 3e-4 of the curvature.
constexpr int cells_a_turn = 128;
constexpr int samples_a_turn = 4 * cells_a_turn;  // times at which the orbit and its Floquet vectors are computed
// For the rotor: cubic interpolation between nodes 0.1 to 0.2 rad apart errs by 1e-6 of an amplitude or less, far below
// any trapping region's size.
constexpr int cells_per_section = 32;
constexpr int most_turns = 16, most_copies = 24, most_sections = 8;  // every state is compared with all of them
constexpr double form_tolerance = 1e-12;

// Components that are compared with the table: all except the phase, if the state contains it.
Eigen::VectorXi compared(const OrbitRegion& region) {
  const int size = static_cast<int>(region.unit.size());
  if (region.phase_place < 0) return Eigen::VectorXi::LinSpaced(size, 0, size - 1);
  Eigen::VectorXi others(size - 1);
  for (int i = 0, k = 0; i < size; ++i)
    if (i != region.phase_place) others[k++] = i;
  return others;
}

// The growth of an orbit's angles in one period.
VectorXd shift_of(const model::System& system, const PeriodicOrbit& orbit) {
  VectorXd shift = VectorXd::Zero(system.dimension());
  const auto angles = system.angles();
  for (std::size_t i = 0; i < angles.size(); ++i) shift[angles[i].place] = angles[i].turn * orbit.winding[i];
  return shift;
}

// The ball whose angle is the phase: it always turns the same way, and the fewest times a period. -1 if there is none.
int clock_of(int balls, const Motion& motion) {
  int clock = -1;
  for (int i = 0; i < balls; ++i) {
    if (motion.winding[i] == 0 || motion.rate_min[i] * motion.rate_max[i] <= 0.0) continue;
    if (clock < 0 || std::abs(motion.winding[i]) < std::abs(motion.winding[clock])) clock = i;
  }
  return clock;
}

// Nodes at the angles 2 pi k / cells_a_turn, k = 0 .. turns * cells_a_turn, of component `clock`, by linear
// interpolation in that angle.
std::vector<Node> nodes_over_angle(const FloquetFrame& frame, const VectorXd& shift, int clock, int turns) {
  const bool rising = shift[clock] > 0.0;
  const int count = static_cast<int>(frame.states.size());
  // Sample j of the doubly infinite orbit, counted so that the clock's angle grows.
  const auto state = [&](int j) -> VectorXd {
    const int forward = rising ? j : -j;
    const int lap = static_cast<int>(std::floor(static_cast<double>(forward) / count));
    return frame.states[forward - lap * count] + lap * shift;
  };
  const auto form = [&](int j) {
    const int forward = rising ? j : -j;
    return floquet_form(frame.left[((forward % count) + count) % count]);
  };
  std::vector<Node> nodes;
  const double first = state(0)[clock];
  // The whole turn next below the first sample's angle; the table starts there.
  const double origin = two_pi * std::floor(first / two_pi);
  int j = 0;
  while (state(j)[clock] > origin) --j;
  for (int k = 0; k <= turns * cells_a_turn; ++k) {
    const double angle = origin + two_pi * k / cells_a_turn;
    while (state(j + 1)[clock] <= angle) ++j;
    const VectorXd a = state(j), b = state(j + 1);
    const double f = (angle - a[clock]) / (b[clock] - a[clock]);
    nodes.push_back({a + f * (b - a), {}, (1.0 - f) * form(j) + f * form(j + 1)});
    nodes.back().state[clock] = angle;
  }
  return nodes;
}

std::vector<OrbitRegion> regions_by_ball(const model::System& system, const Motion& motion, int attractor) {
  if (motion.kind != MotionKind::periodic || motion.copies > most_copies) return {};
  OrbitRegion region;
  region.attractor = attractor;
  region.clock = clock_of(system.balls(), motion);
  if (region.clock < 0) return {};
  region.phase_place = model::index::phi(region.clock);
  region.turns = std::abs(motion.winding[region.clock]);
  region.cells = cells_a_turn;
  region.unit = VectorXd::Ones(system.dimension());
  if (region.turns > most_turns) return {};
  const auto frame = floquet_frame(system, motion.orbit, samples_a_turn * region.turns);
  if (!frame) return {};
  region.nodes = nodes_over_angle(*frame, shift_of(system, motion.orbit), region.phase_place, region.turns);
  if (!is_definite(region)) return {};
  std::vector<OrbitRegion> regions;
  for (const BallOrder& order : exchange_images(system, motion))
    regions.push_back(exchanged(region, system.balls(), order));
  return regions;
}

// The orbit's nodes and its linear flow between them, in units of deviations.
struct Arcs {
  std::vector<Node> nodes;
  std::vector<MatrixXd> flows;
};

std::optional<Arcs> arcs_over_sections(const model::System& system, const PeriodicOrbit& orbit, const VectorXd& unit) {
  const double h = system.section_period() / cells_per_section;
  const double step_angle = system.section_angle() / cells_per_section * (system.speed() < 0.0 ? -1.0 : 1.0);
  Arcs arcs;
  for (const VectorXd& on_section : orbit.nodes) {
    VectorXd z = on_section;
    for (int k = 0; k < cells_per_section; ++k) {
      const double psi = step_angle * k;
      arcs.nodes.push_back({z, model::rate(system, z, psi), {}});
      auto arc = follow_derivative(system, z, h, form_tolerance, psi);
      if (!arc) return std::nullopt;
      arcs.flows.push_back(in_units(arc->tangents, unit));
      z = std::move(arc->end);
    }
  }
  return arcs;
}

// Follows `z`, on a motion whose rotor angle only grows or only falls, to where that angle is `psi`, with the
// derivative. Newton's method on the time.
std::optional<TangentFlight> follow_to_angle(const model::System& system, const VectorXd& z, double psi) {
  const int place = system.layout().psi;
  double time = (psi - z[place]) / system.speed(z);
  for (int k = 0; k < 20; ++k) {
    if (!(time >= 0.0)) return std::nullopt;
    auto flight = follow_derivative(system, z, time, form_tolerance);
    if (!flight) return std::nullopt;
    const double miss = psi - flight->end[place];
    if (std::fabs(miss) < 1e-11) return flight;
    time += miss / system.speed(flight->end);
  }
  return std::nullopt;
}

// The same with a motor, from one rotor angle to the next: a deviation in that angle is shifted along the motion until
// it vanishes.
std::optional<Arcs> arcs_over_turns(const model::System& system, const Motion& motion, const OrbitRegion& region) {
  const int place = region.phase_place;
  const double turn = motion.speed < 0.0 ? -system.section_angle() : system.section_angle(),
               step = turn / cells_per_section;
  const VectorXd& first = motion.orbit.nodes.front();
  const auto start = follow_to_angle(system, first, turn * std::ceil(first[place] / turn));
  if (!start) return std::nullopt;
  VectorXd z = start->end;
  z[place] = 0.0;
  const Eigen::VectorXi others = compared(region);
  Arcs arcs;
  for (int k = 0; k < region.rows(); ++k) {
    arcs.nodes.push_back({z, model::rate(system, z) / std::fabs(system.speed(z)), {}});
    auto arc = follow_to_angle(system, z, step * (k + 1));
    if (!arc) return std::nullopt;
    z = std::move(arc->end);
    const VectorXd along = model::rate(system, z) / system.speed(z);
    const MatrixXd across = arc->tangents - along * arc->tangents.row(place);
    arcs.flows.push_back(in_units(across, region.unit)(others, others));
  }
  return arcs;
}

// P = integral of |d|^2 e^{2 a t} along the linear flow, a = 0.8 of the slowest rate, so that V falls at least as e^{-2
// a t}; scaled so that V is |d|^2 or more. False if there is none.
bool integrate_forms(Arcs& arcs, double h, double slowest_rate) {
  const double growth = std::exp(-share_of_rate * slowest_rate * h);
  const Index size = arcs.flows.front().rows();
  const MatrixXd one = MatrixXd::Identity(size, size);
  const auto before = [&](const MatrixXd& form, const MatrixXd& flow) -> MatrixXd {
    return h * one + growth * growth * flow.transpose() * form * flow;
  };
  MatrixXd all = one, once = MatrixXd::Zero(size, size);
  for (const MatrixXd& flow : arcs.flows) all = growth * flow * all;
  for (auto flow = arcs.flows.rbegin(); flow != arcs.flows.rend(); ++flow) once = before(once, *flow);
  const auto form = solve_stein(all, once);
  if (!form) return false;
  arcs.nodes.back().form = *form;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = arcs.flows.size(); k-- > 0;) {
    arcs.nodes[k].form = before(arcs.nodes[k + 1].form, arcs.flows[k]);
    least = std::min(least, dense::symmetric_eigenvalues(arcs.nodes[k].form).minCoeff());
  }
  if (!(least > 0.0)) return false;
  for (Node& node : arcs.nodes) node.form /= least;
  return true;
}

std::vector<OrbitRegion> regions_by_rotor(const model::System& system, const Motion& motion, int attractor) {
  const bool continuum = motion.kind == MotionKind::equilibrium && model::balanced_freedom(system) > 0;
  if (continuum || motion.orbit.nodes.empty() || motion.sections < 1 || motion.sections > most_sections) return {};
  // If the rotor turns back on its way, its angle is no phase.
  if (motion.motor && !(motion.motor->speed_min * motion.motor->speed_max > 0.0)) return {};
  OrbitRegion region;
  region.attractor = attractor;
  region.phase_place = system.layout().psi;
  region.turns = motion.sections;
  region.cells = cells_per_section;
  region.unit = system.scale();
  auto arcs = system.prescribed() ? arcs_over_sections(system, motion.orbit, region.unit)
                                  : arcs_over_turns(system, motion, region);
  if (!arcs) return {};
  Node again = arcs->nodes.front();  // a period later
  again.state += shift_of(system, motion.orbit);
  arcs->nodes.push_back(std::move(again));
  const double time = system.prescribed() ? system.section_period() / cells_per_section
                                          : motion.orbit.period / region.rows();  // of a cell, on average
  if (!integrate_forms(*arcs, time, motion.orbit.slowest_rate())) return {};
  region.nodes = std::move(arcs->nodes);
  return {region};
}

}  // namespace

Eigen::MatrixXd floquet_form(const Eigen::MatrixXcd& left) { return (left.conjugate() * left.transpose()).real(); }

std::vector<OrbitRegion> orbit_regions(const model::System& system, const Motion& motion, int attractor) {
  if (!motion.stable) return {};
  return system.autonomous() ? regions_by_ball(system, motion, attractor) : regions_by_rotor(system, motion, attractor);
}

namespace {

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
