// Newton's method for periodic orbits, by multiple shooting with a free or an imposed period.
#include "equipoise/attractors/periodic_orbits/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Step error of every integration here, for orbits true to twelve digits.
constexpr double orbit_tolerance = 1e-12;
// States this close, in units of their scale, are the same: far above any residual, far below any motion's size.
constexpr double same_state = 1e-7;
// With an imposed period, a shooting matrix of worse condition belongs to a continuum.
constexpr double singular_orbit = 1e-8;
constexpr double longest_arc = 2.0;  // a node's part of the period, unless the guess sets it
constexpr int fewest_nodes = 8, most_nodes = 32;

int node_count(double period) {
  return static_cast<int>(std::clamp(std::ceil(period / longest_arc), double(fewest_nodes), double(most_nodes)));
}

// States at the increasing times `times` >= 0, each followed from the last of `states` (at equal parts of `period`) or
// of those found before it. Empty if an integration fails.
std::vector<VectorXd> states_at(const model::System& system, const std::vector<VectorXd>& states, double period,
                                const std::vector<double>& times) {
  const double spacing = period / static_cast<double>(states.size());
  const double rounding = 1e-9 * spacing;  // a state this near in time is the one requested
  std::vector<VectorXd> result;
  double begin = -1.0;  // time of `state`
  VectorXd state;
  for (const double t : times) {
    const auto k = std::min(static_cast<std::size_t>((t + rounding) / spacing), states.size() - 1);
    if (const double node = spacing * static_cast<double>(k); node > begin) {
      begin = node;
      state = states[k];
    }
    if (t - begin > rounding) {
      auto next = advance_state(system, state, t - begin, system.speed() * begin);
      if (!next) return {};
      begin = t;
      state = *std::move(next);
    }
    result.push_back(state);
  }
  return result;
}

// `count` states at equal parts of `span`. Empty if an integration fails.
std::vector<VectorXd> resample(const model::System& system, const std::vector<VectorXd>& states, double period,
                               double span, int count) {
  std::vector<double> times(std::max(count, 0));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = span * static_cast<double>(k) / count;
  return states_at(system, states, period, times);
}

// The unknowns of multiple shooting, and the results of one pass along all arcs.
struct Shooting {
  std::vector<VectorXd> nodes;
  double period = 0.0;
  bool imposed = false;  // the period is not solved for
  // From evaluate():
  std::vector<TangentFlight> arcs;  // from the nodes
  std::vector<VectorXd> rates;      // dz/dt at each arc's end
  VectorXd mismatch;                // arc ends minus next nodes, and 0 for the phase condition, in units of their scale
  double residual = 0.0;            // its largest component, in that component's unit
};

class OrbitProblem {
 public:
  OrbitProblem(const model::System& system, std::size_t nodes, double step_error, const StopFlag* stop)
      : system_(system),
        angles_(system.angles()),
        unit_(system.scale()),
        tolerance_(step_error),
        nodes_(nodes),
        size_(unit_.size()),
        stop_(stop) {}

  // Whole turns of each angle from the first node to the end of the last arc.
  std::optional<Winding> find_winding(const Shooting& guess) {
    const auto end = advance_state(system_, guess.nodes.back(), guess.period / double(nodes_));
    if (!end) return std::nullopt;
    for (std::size_t i = 0; i < angles_.size(); ++i) {
      const auto& [place, turn] = angles_[i];
      winding_[i] = static_cast<int>(std::lround(((*end)[place] - guess.nodes.front()[place]) / turn));
    }
    return winding_;
  }

  bool evaluate(Shooting& s) const {
    s.arcs = follow_arcs(system_, s.nodes, s.period / double(nodes_), tolerance_, stop_);
    s.rates.clear();
    s.residual = 0.0;
    s.mismatch = VectorXd::Zero(unknowns(s));
    if (s.arcs.empty()) return false;
    for (std::size_t k = 0; k < nodes_; ++k) {
      VectorXd miss = s.arcs[k].end - s.nodes[(k + 1) % nodes_];
      if (k + 1 == nodes_)
        for (std::size_t i = 0; i < angles_.size(); ++i) miss[angles_[i].place] -= angles_[i].turn * winding_[i];
      s.residual = std::max(s.residual, miss.lpNorm<Eigen::Infinity>());
      s.mismatch.segment(size_ * Index(k), size_) = miss.cwiseQuotient(unit_);
      if (!s.imposed) s.rates.push_back(model::rate(system_, s.arcs[k].end).cwiseQuotient(unit_));
    }
    return true;
  }

  // Derivative of the mismatch with respect to all nodes (in units of their scale) and to a free period (in units of
  // itself). For a free period the last row fixes the phase: no change along the motion, on average over the nodes.
  MatrixXd matrix(const Shooting& s) const {
    const Index last = size_ * Index(nodes_);
    MatrixXd m = MatrixXd::Zero(unknowns(s), unknowns(s));
    for (std::size_t k = 0; k < nodes_; ++k) {
      const Index row = size_ * Index(k), next = size_ * Index((k + 1) % nodes_);
      m.block(row, row, size_, size_) = in_units(s.arcs[k].tangents, unit_);
      m.block(row, next, size_, size_) -= MatrixXd::Identity(size_, size_);
      if (s.imposed) continue;
      m.block(row, last, size_, 1) = s.rates[k] * (s.period / double(nodes_));
      // Once converged, the rate at the end of an arc is that at the next node.
      m.block(last, next, 1, size_) = s.rates[k].transpose();
    }
    return m;
  }

  Shooting moved(const Shooting& s, const VectorXd& change, double share) const {
    Shooting result;
    result.imposed = s.imposed;
    for (std::size_t k = 0; k < nodes_; ++k)
      result.nodes.push_back(s.nodes[k] + share * unit_.cwiseProduct(change.segment(size_ * Index(k), size_)));
    result.period = s.imposed ? s.period : s.period * (1.0 + share * change[change.size() - 1]);
    return result;
  }

  // Factor on what steps leave: a rotor that hangs far below its supports has large x and y.
  double coarser() const { return std::max(1.0, std::fabs(model::static_sag(system_.parameters()))); }

  // How far a change moves the node that moves furthest.
  double farthest(const VectorXd& change) const {
    double result = 0.0;
    for (std::size_t k = 0; k < nodes_; ++k) result = std::max(result, change.segment(size_ * Index(k), size_).norm());
    return result;
  }
  double distance(const Shooting& a, const Shooting& b) const {
    double result = 0.0;
    for (std::size_t k = 0; k < nodes_; ++k)
      result = std::max(result, (a.nodes[k] - b.nodes[k]).cwiseQuotient(unit_).norm());
    return result;
  }

 private:
  Index unknowns(const Shooting& s) const { return size_ * Index(nodes_) + (s.imposed ? 0 : 1); }

  const model::System& system_;
  std::vector<model::System::Angle> angles_;
  VectorXd unit_;
  double tolerance_;
  std::size_t nodes_;
  Index size_;
  const StopFlag* stop_;
  Winding winding_{};
};

// Newton's steps. With an imposed period a singular matrix belongs to a continuum, and the least step leads to its
// nearest member. With a free period it belongs to a bifurcation.
class NewtonSteps {
 public:
  NewtonSteps(const MatrixXd& m, bool imposed) : lu_(m) {
    if (imposed && !(lu_.inverse_condition() > singular_orbit)) least_.emplace(m, singular_orbit);
  }
  VectorXd to_zero(const VectorXd& mismatch) const {
    return least_ ? VectorXd(-least_->solve(mismatch)) : VectorXd(-lu_.solve(mismatch));
  }

 private:
  dense::LinearSolver lu_;
  std::optional<dense::LeastNormSolver> least_;
};

// How hard Newton's method tries.
struct Effort {
  double tolerance;         // step error of the integrations
  double converged;         // a full step this short is the last
  double largest_residual;  // of a converged orbit with a free period
  double noise;             // error that the integration leaves in a step
  int most_iterations;
  double shortest_share;  // of a damped step
};
// Full steps this short square to rounding. The residual is what some hundred steps leave at that tolerance. If a
// multiplier is near 1, the next step magnifies it a hundredfold or more.
constexpr Effort refining{orbit_tolerance, 1e-8, 1e-11, 1e-9, 40, 1.0 / 1024};
// From a neighbour's motion, which this system may lack: if few steps do not reach it, many seldom do.
constexpr Effort continuing{orbit_tolerance, 1e-8, 1e-11, 1e-9, 10, 1.0 / 8};
// Arcs between sections have their given length.
constexpr double longer_arcs = 10.0;
constexpr Effort searching{1e-9, 1e-4, 1e300, 1e-6, 10, 1.0};

// Newton's method, damped by the natural monotonicity test (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004,
// section 3.3): a step is accepted if the next step with the same matrix would be shorter. False if it does not
// converge, if a step is longer than `reach`, or if all steps together lead twice as far.
bool solve(const OrbitProblem& problem, Shooting& s, const Effort& effort, double reach) {
  if (!problem.evaluate(s)) return false;
  const Shooting first = s;
  const double coarser = problem.coarser();
  const double largest_residual = effort.largest_residual * coarser * (s.imposed ? longer_arcs : 1.0);
  for (int iteration = 0; iteration < effort.most_iterations; ++iteration) {
    const NewtonSteps steps(problem.matrix(s), s.imposed);
    const VectorXd change = steps.to_zero(s.mismatch);
    const double length = change.norm();
    if (!std::isfinite(length) || problem.farthest(change) > reach) return false;
    for (double share = 1.0;; share *= 0.5) {
      if (share < effort.shortest_share) return false;
      Shooting trial = problem.moved(s, change, share);
      // A period that halves or doubles belongs to another orbit.
      if (!(trial.period > 0.5 * first.period && trial.period < 2.0 * first.period) || !problem.evaluate(trial))
        continue;
      const double next = steps.to_zero(trial.mismatch).norm();
      if (!(next <= std::max((1.0 - 0.25 * share) * length, effort.noise * coarser))) continue;
      s = std::move(trial);
      if (problem.distance(s, first) > 2.0 * reach) return false;
      if (share == 1.0 && length < effort.converged * coarser && s.residual < largest_residual) return true;
      break;
    }
  }
  return false;
}

bool is_equilibrium(const model::System& system, const Shooting& s) {
  if (s.imposed) return false;
  double fastest = 0.0;
  for (const VectorXd& z : s.nodes)
    fastest = std::max(fastest, model::rate(system, z).cwiseQuotient(system.scale()).lpNorm<Eigen::Infinity>());
  return fastest * s.period < same_state;
}

// A whole number by which the period and the winding can be divided, 1 if there is none. With a free period numbers up
// to 8 are tried; on a stroboscopic section only nodes can be compared.
int repeats(const model::System& system, const Shooting& s, const Winding& winding) {
  const auto angles = system.angles();
  const int nodes = static_cast<int>(s.nodes.size()), most = s.imposed ? nodes : 8;
  for (int k = most; k > 1; --k) {
    if (s.imposed && nodes % k != 0) continue;
    if (std::any_of(winding.begin(), winding.end(), [k](int turns) { return turns % k != 0; })) continue;
    const auto there = states_at(system, s.nodes, s.period, {s.period / k});
    if (there.empty()) continue;
    VectorXd miss = there[0] - s.nodes[0];
    for (std::size_t i = 0; i < angles.size(); ++i) miss[angles[i].place] -= angles[i].turn * (winding[i] / k);
    if (miss.cwiseQuotient(system.scale()).lpNorm<Eigen::Infinity>() < same_state) return k;
  }
  return 1;
}

// Makes one period of `times` of them. False if an integration fails.
bool shorten(const model::System& system, Shooting& s, int times) {
  const double once = s.period / times;
  if (s.imposed)
    s.nodes.resize(s.nodes.size() / static_cast<std::size_t>(times));
  else
    s.nodes = resample(system, s.nodes, s.period, once, node_count(once));
  s.period = once;
  return !s.nodes.empty();
}

std::optional<PeriodicOrbit> refine(const model::System& system, Shooting s, double reach, const StopFlag* stop,
                                    const Effort& effort = refining) {
  for (const auto& angle : system.angles()) {  // whole turns come off, so that angles keep their digits
    const double turns = angle.turn * std::floor(s.nodes[0][angle.place] / angle.turn);
    for (VectorXd& z : s.nodes) z[angle.place] -= turns;
  }
  for (;;) {
    OrbitProblem problem(system, s.nodes.size(), effort.tolerance, stop);
    const auto winding = problem.find_winding(s);
    if (!winding || !solve(problem, s, effort, reach) || is_equilibrium(system, s)) return std::nullopt;
    const int times = repeats(system, s, *winding);
    if (times == 1) {
      PeriodicOrbit orbit{s.period, *winding, s.nodes, {}, s.residual, s.imposed};
      orbit.multipliers = s.imposed ? floquet_multipliers(s.arcs) : floquet_multipliers(system, s.nodes, s.arcs);
      return orbit;
    }
    if (!shorten(system, s, times)) return std::nullopt;
  }
}

}  // namespace

std::optional<PeriodicOrbit> refine_orbit(const model::System& system, const std::vector<VectorXd>& guess,
                                          double period, double reach, const StopFlag* stop) {
  if (system.section() == model::Section::stroboscopic)
    return refine_imposed_orbit(system, guess, system.section_period(), reach, stop);
  if (guess.empty() || !(period > 0.0)) return std::nullopt;
  const int given = static_cast<int>(guess.size());
  const bool as_given = given >= fewest_nodes && given <= most_nodes;
  Shooting s;
  s.period = period;
  s.nodes = as_given ? guess : resample(system, guess, period, period, node_count(period));
  return s.nodes.empty() ? std::nullopt : refine(system, std::move(s), reach, stop);
}

std::optional<PeriodicOrbit> refine_imposed_orbit(const model::System& system, const std::vector<VectorXd>& guess,
                                                  double section_period, double reach, const StopFlag* stop) {
  if (guess.empty()) return std::nullopt;
  Shooting s;
  s.period = section_period * static_cast<double>(guess.size());
  s.nodes = guess;
  s.imposed = true;
  return refine(system, std::move(s), reach, stop);
}

std::optional<PeriodicOrbit> continue_orbit(const model::System& system, const PeriodicOrbit& neighbour, double reach,
                                            const StopFlag* stop) {
  Shooting s;
  s.period = neighbour.period;
  s.nodes = neighbour.nodes;
  s.imposed = neighbour.imposed;
  auto orbit = refine(system, std::move(s), reach, stop, continuing);
  return orbit && orbit->winding == neighbour.winding ? orbit : std::nullopt;
}

std::optional<PeriodicOrbit> find_orbit(const model::System& system, const VectorXd& state, double period, double reach,
                                        const StopFlag* stop) {
  OrbitProblem problem(system, 1, searching.tolerance, stop);
  Shooting s;
  s.nodes = {state};
  s.period = period;
  if (!problem.find_winding(s) || !solve(problem, s, searching, reach)) return std::nullopt;
  return refine_orbit(system, s.nodes, s.period, std::numeric_limits<double>::infinity(), stop);
}

std::vector<VectorXd> sample_orbit(const model::System& system, const PeriodicOrbit& orbit, int count) {
  return resample(system, orbit.nodes, orbit.period, orbit.period, count);
}

}  // namespace equipoise
