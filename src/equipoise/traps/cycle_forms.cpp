// Two kinds of form. Along a motion whose period is free nothing brings a deviation back: the form is made of Floquet
// vectors, which have no part along it, so that the phase may be any angle that grows. Where states are strobed the
// phase is imposed and every deviation shrinks: the integral of its square along the linear flow weighs them all, and
// needs no eigenvectors, which double precision cannot separate where multipliers span many powers of ten (drag).
#include "equipoise/traps/cycle_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "equipoise/base/angles.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/math/lyapunov.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Node = CycleTrap::Node;

// Of a ball, by chords: one misses its arc by (2 pi / 128)^2 / 8 = 3e-4 of the curvature.
constexpr int cells_a_turn = 128;
constexpr int samples_a_turn = 4 * cells_a_turn;  // times at which the orbit and its Floquet vectors are computed
// Of the rotor: cubic interpolation between nodes 0.1 to 0.2 rad apart errs by 1e-6 of an amplitude or less, far below
// any trap's size.
constexpr int cells_a_strobe = 32;
constexpr int most_turns = 16, most_copies = 24, most_strobes = 8;  // all of them are compared with every state
constexpr double tolerance = 1e-12;
// Share of the slowest rate that the form's decay is asked to reach: nearer to 1 it would be all slow directions.
constexpr double share_of_rate = 0.8;

// What an orbit's angles grow by in one period.
VectorXd shift_of(const model::System& system, const PeriodicOrbit& orbit) {
  VectorXd shift = VectorXd::Zero(system.dimension());
  for (int i = 0; i < system.balls(); ++i) shift[model::index::phi(i)] = two_pi * orbit.winding[i];
  return shift;
}

// The ball whose angle tells the phase: it turns, always the same way, and fewest times a period; -1 if there is none.
int clock_of(int balls, const Motion& motion) {
  int clock = -1;
  for (int i = 0; i < balls; ++i) {
    if (motion.winding[i] == 0 || motion.rate_min[i] * motion.rate_max[i] <= 0.0) continue;
    if (clock < 0 || std::abs(motion.winding[i]) < std::abs(motion.winding[clock])) clock = i;
  }
  return clock;
}

// The orbit sampled in time, with its forms P = sum_k Re(conj(w_k) w_k^T).
struct Samples {
  std::vector<VectorXd> states;
  std::vector<MatrixXd> forms;
  VectorXd shift;  // from one period to the next
};

std::optional<Samples> sample(const model::System& system, const Motion& motion, int count) {
  auto frame = floquet_frame(system, motion.orbit, count);
  if (!frame) return std::nullopt;
  Samples samples;
  samples.states = std::move(frame->states);
  for (const Eigen::MatrixXcd& left : frame->left)
    samples.forms.push_back((left.conjugate() * left.transpose()).real());
  samples.shift = shift_of(system, motion.orbit);
  return samples;
}

// Nodes at the angles 2 pi k / cells_a_turn, k = 0 .. turns * cells_a_turn, of component `clock`, by linear
// interpolation in that angle.
std::vector<Node> nodes_over_angle(const Samples& samples, int clock, int turns) {
  const bool rising = samples.shift[clock] > 0.0;
  const int count = static_cast<int>(samples.states.size());
  // Sample j of the doubly infinite orbit, j counted so that the clock's angle grows.
  const auto state = [&](int j) -> VectorXd {
    const int forward = rising ? j : -j;
    const int lap = static_cast<int>(std::floor(static_cast<double>(forward) / count));
    return samples.states[forward - lap * count] + lap * samples.shift;
  };
  const auto form = [&](int j) -> const MatrixXd& {
    const int forward = rising ? j : -j;
    return samples.forms[((forward % count) + count) % count];
  };
  std::vector<Node> nodes;
  const double first = state(0)[clock];
  // The whole turn nearest below the first sample's angle; the table starts there.
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

std::vector<CycleTrap> traps_by_ball(const model::System& system, const Motion& motion, int attractor) {
  if (motion.kind != MotionKind::periodic || motion.copies > most_copies) return {};
  CycleTrap trap;
  trap.attractor = attractor;
  trap.clock = clock_of(system.balls(), motion);
  if (trap.clock < 0) return {};
  trap.turns = std::abs(motion.winding[trap.clock]);
  trap.cells = cells_a_turn;
  trap.unit = VectorXd::Ones(system.dimension());
  if (trap.turns > most_turns) return {};
  const auto samples = sample(system, motion, samples_a_turn * trap.turns);
  if (!samples) return {};
  trap.nodes = nodes_over_angle(*samples, model::index::phi(trap.clock), trap.turns);
  if (!is_definite(trap)) return {};
  std::vector<CycleTrap> traps;
  for (const BallOrder& order : exchange_images(system, motion))
    traps.push_back(exchanged(trap, system.balls(), order));
  return traps;
}

// The orbit's nodes and its linear flow from one to the next, the latter in units of deviations.
struct Arcs {
  std::vector<Node> nodes;
  std::vector<MatrixXd> flows;
};

std::optional<Arcs> arcs_over_strobes(const model::System& system, const PeriodicOrbit& orbit, const VectorXd& unit) {
  const double h = system.strobe_period() / cells_a_strobe;
  const double step_angle = system.strobe_angle() / cells_a_strobe * (system.speed() < 0.0 ? -1.0 : 1.0);
  Arcs arcs;
  for (const VectorXd& at_strobe : orbit.nodes) {
    VectorXd z = at_strobe;
    for (int k = 0; k < cells_a_strobe; ++k) {
      const double psi = step_angle * k;
      arcs.nodes.push_back({z, model::rate(system, z, psi), {}});
      auto arc = follow_derivative(system, z, h, tolerance, psi);
      if (!arc) return std::nullopt;
      arcs.flows.push_back(unit.cwiseInverse().asDiagonal() * arc->tangents * unit.asDiagonal());
      z = std::move(arc->end);
    }
  }
  Node again = arcs.nodes.front();
  again.state += shift_of(system, orbit);
  arcs.nodes.push_back(std::move(again));
  return arcs;
}

// P = integral of |d|^2 e^{2 a t} along the linear flow, a = 0.8 of the slowest rate, so that V falls at least as
// e^{-2 a t}; scaled so that V is |d|^2 or more. False if there is none.
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

std::vector<CycleTrap> traps_by_rotor(const model::System& system, const Motion& motion, int attractor) {
  const bool continuum = motion.kind == MotionKind::equilibrium && continuum_dimension(system.parameters()) > 0;
  if (continuum || motion.orbit.nodes.empty() || motion.orbit.nodes.size() > most_strobes) return {};
  CycleTrap trap;
  trap.attractor = attractor;
  trap.turns = static_cast<int>(motion.orbit.nodes.size());
  trap.cells = cells_a_strobe;
  trap.unit = system.scale();
  auto arcs = arcs_over_strobes(system, motion.orbit, trap.unit);
  if (!arcs || !integrate_forms(*arcs, system.strobe_period() / cells_a_strobe, motion.orbit.slowest_rate())) return {};
  trap.nodes = std::move(arcs->nodes);
  return {trap};
}

}  // namespace

std::vector<CycleTrap> cycle_traps(const model::System& system, const Motion& motion, int attractor) {
  if (!motion.stable) return {};
  return system.section() == model::Section::strobe ? traps_by_rotor(system, motion, attractor)
                                                    : traps_by_ball(system, motion, attractor);
}

}  // namespace equipoise
