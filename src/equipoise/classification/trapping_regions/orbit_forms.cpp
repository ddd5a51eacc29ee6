// Two kinds of forms. Along a motion with a free period nothing brings a deviation back, so the form is made of Floquet
// vectors, which have no part along it; the phase may be any angle that grows. On a stroboscopic section the phase is
// imposed and every deviation shrinks, so the form integrates its square along the linear flow. That needs no
// eigenvectors, which double precision cannot separate if multipliers span many powers of ten (drag).
#include "equipoise/classification/trapping_regions/orbit_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/core/math/lyapunov.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

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
      arcs.flows.push_back(unit.cwiseInverse().asDiagonal() * arc->tangents * unit.asDiagonal());
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
std::optional<Arcs> arcs_over_turns(const model::System& system, const Motion& motion, const VectorXd& unit,
                                    int turns) {
  const int place = system.layout().psi, size = system.dimension(), cells = cells_per_section * turns;
  const double turn = motion.speed < 0.0 ? -system.section_angle() : system.section_angle(),
               step = turn / cells_per_section;
  const VectorXd& first = motion.orbit.nodes.front();
  const auto start = follow_to_angle(system, first, turn * std::ceil(first[place] / turn));
  if (!start) return std::nullopt;
  VectorXd z = start->end;
  z[place] = 0.0;
  Eigen::VectorXi others(size - 1);
  for (int i = 0, k = 0; i < size; ++i)
    if (i != place) others[k++] = i;
  Arcs arcs;
  for (int k = 0; k < cells; ++k) {
    arcs.nodes.push_back({z, model::rate(system, z) / std::fabs(system.speed(z)), {}});
    auto arc = follow_to_angle(system, z, step * (k + 1));
    if (!arc) return std::nullopt;
    z = std::move(arc->end);
    const VectorXd along = model::rate(system, z) / system.speed(z);
    const MatrixXd across = arc->tangents - along * arc->tangents.row(place);
    const MatrixXd scaled = unit.cwiseInverse().asDiagonal() * across * unit.asDiagonal();
    arcs.flows.push_back(scaled(others, others));
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
                                  : arcs_over_turns(system, motion, region.unit, region.turns);
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

}  // namespace equipoise
