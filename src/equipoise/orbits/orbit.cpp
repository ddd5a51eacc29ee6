// Newton's method for equilibria and, by multiple shooting, for periodic orbits.
#include "equipoise/orbits/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include <Eigen/Eigenvalues>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/orbits/floquet.hpp"
#include "equipoise/orbits/variational.hpp"

namespace equipoise {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Step error of every integration here: orbits are wanted to twelve digits.
constexpr double tolerance = 1e-12;
// Largest mismatch of a converged orbit: what some hundred steps at that tolerance leave.
constexpr double largest_residual = 1e-11;
// States this close, in units of their scale, are the same: far above the residual, far below any motion's size.
constexpr double same_state = 1e-7;
constexpr double longest_arc = 2.0;  // of a node's share of the period, where the guess does not say
constexpr int fewest_nodes = 8, most_nodes = 32;

int node_count(double period) {
  return static_cast<int>(std::clamp(std::ceil(period / longest_arc), double(fewest_nodes), double(most_nodes)));
}

// States at the increasing times `times` >= 0, each followed from the last of `states` (at equal shares of `period`)
// or of those already found before it. Empty if an integration fails.
std::vector<VectorXd> states_at(const model::Parameters& p, double speed, const std::vector<VectorXd>& states,
                                double period, const std::vector<double>& times) {
  const double spacing = period / static_cast<double>(states.size());
  const double rounding = 1e-9 * spacing;  // a state this near in time is the one asked for
  std::vector<VectorXd> result;
  double begin = -1.0;  // of `state`
  VectorXd state;
  for (const double t : times) {
    const auto k = std::min(static_cast<std::size_t>((t + rounding) / spacing), states.size() - 1);
    if (const double node = spacing * static_cast<double>(k); node > begin) {
      begin = node;
      state = states[k];
    }
    if (t - begin > rounding) {
      auto next = advance_state(p, speed, state, t - begin);
      if (!next) return {};
      begin = t;
      state = *std::move(next);
    }
    result.push_back(state);
  }
  return result;
}

// `count` states at equal shares of `span`. Empty if an integration fails.
std::vector<VectorXd> resample(const model::Parameters& p, double speed, const std::vector<VectorXd>& states,
                               double period, double span, int count) {
  std::vector<double> times(std::max(count, 0));
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = span * static_cast<double>(k) / count;
  return states_at(p, speed, states, period, times);
}

using Winding = std::array<int, model::max_balls>;

// What multiple shooting solves for, and what one pass along all arcs gives.
struct Shooting {
  std::vector<VectorXd> nodes;
  double period = 0.0;
  // Of evaluate():
  std::vector<MatrixXd> arcs;   // derivative of each arc's end with respect to its node
  std::vector<VectorXd> rates;  // dz/dt at each arc's end
  VectorXd mismatch;            // arc ends minus next nodes, and 0 for the phase condition
};

class OrbitProblem {
 public:
  OrbitProblem(const model::Parameters& p, double speed, std::size_t nodes)
      : p_(p), speed_(speed), unit_(state_scale(p)), nodes_(nodes), size_(unit_.size()) {}

  const VectorXd& unit() const { return unit_; }

  // Whole turns of each ball from the first node to the end of the last arc.
  std::optional<Winding> find_winding(const Shooting& guess) {
    const auto end = advance_state(p_, speed_, guess.nodes.back(), guess.period / double(nodes_));
    if (!end) return std::nullopt;
    for (int i = 0; i < p_.balls; ++i) {
      const int phi = model::index::phi(i);
      winding_[i] = static_cast<int>(std::lround(((*end)[phi] - guess.nodes.front()[phi]) / two_pi));
    }
    return winding_;
  }

  bool evaluate(Shooting& s) const {
    s.arcs.clear();
    s.rates.clear();
    s.mismatch = VectorXd::Zero(size_ * Index(nodes_) + 1);
    for (std::size_t k = 0; k < nodes_; ++k) {
      auto arc = follow_derivative(p_, speed_, s.nodes[k], s.period / double(nodes_), tolerance);
      if (!arc) return false;
      VectorXd miss = arc->end - s.nodes[(k + 1) % nodes_];
      if (k + 1 == nodes_)
        for (int i = 0; i < p_.balls; ++i) miss[model::index::phi(i)] -= two_pi * winding_[i];
      s.mismatch.segment(size_ * Index(k), size_) = miss;
      s.rates.push_back(model::derivative(p_, speed_, arc->end.data()));
      s.arcs.push_back(std::move(arc->tangents));
    }
    return s.mismatch.allFinite();
  }

  // Derivative of the mismatch with respect to all nodes (in units of their scale) and the period (in units of itself).
  // Last row: no change along the motion, on the mean over the nodes, which fixes the phase.
  MatrixXd matrix(const Shooting& s) const {
    const Index last = size_ * Index(nodes_);
    MatrixXd m = MatrixXd::Zero(last + 1, last + 1);
    for (std::size_t k = 0; k < nodes_; ++k) {
      const Index row = size_ * Index(k), next = size_ * Index((k + 1) % nodes_);
      m.block(row, row, size_, size_) = s.arcs[k] * unit_.asDiagonal();
      m.block(row, next, size_, size_) -= unit_.asDiagonal().toDenseMatrix();
      m.block(row, last, size_, 1) = s.rates[k] * (s.period / double(nodes_));
      // The rate at the end of the arc before is that at this node once converged.
      m.block(last, next, 1, size_) = s.rates[k].cwiseQuotient(unit_).transpose();
    }
    return m;
  }

  Shooting moved(const Shooting& s, const VectorXd& change, double share) const {
    Shooting result;
    for (std::size_t k = 0; k < nodes_; ++k)
      result.nodes.push_back(s.nodes[k] + share * unit_.cwiseProduct(change.segment(size_ * Index(k), size_)));
    result.period = s.period * (1.0 + share * change[change.size() - 1]);
    return result;
  }

 private:
  const model::Parameters& p_;
  double speed_;
  VectorXd unit_;
  std::size_t nodes_;
  Index size_;
  Winding winding_{};
};

// Newton's method, damped by the natural monotonicity test (P. Deuflhard, Newton Methods for Nonlinear Problems, 2004,
// section 3.3): a step is accepted if the next step, with the matrix kept, would be shorter. False if it does not
// converge.
bool solve(const OrbitProblem& problem, Shooting& s) {
  constexpr int most_iterations = 40;
  constexpr double shortest_share = 1.0 / 1024;
  // A full step this short squares to rounding; changes below `noise` are what the integration leaves.
  constexpr double converged = 1e-8, noise = 1e-11;
  const double period = s.period;
  if (!problem.evaluate(s)) return false;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Eigen::PartialPivLU<MatrixXd> lu(problem.matrix(s));
    const VectorXd change = -lu.solve(s.mismatch);
    const double length = change.norm();
    if (!std::isfinite(length)) return false;
    for (double share = 1.0;; share *= 0.5) {
      if (share < shortest_share) return false;
      Shooting trial = problem.moved(s, change, share);
      // A period that halves or doubles belongs to another orbit.
      if (!(trial.period > 0.5 * period && trial.period < 2.0 * period) || !problem.evaluate(trial)) continue;
      const double next = lu.solve(trial.mismatch).norm();
      if (!(next <= std::max((1.0 - 0.25 * share) * length, noise))) continue;
      s = std::move(trial);
      if (share == 1.0 && length < converged && s.mismatch.lpNorm<Eigen::Infinity>() < largest_residual) return true;
      break;
    }
  }
  return false;
}

bool is_equilibrium(const model::Parameters& p, double speed, const Shooting& s, const VectorXd& unit) {
  double fastest = 0.0;
  for (const VectorXd& z : s.nodes)
    fastest = std::max(fastest, model::derivative(p, speed, z.data()).cwiseQuotient(unit).lpNorm<Eigen::Infinity>());
  return fastest * s.period < same_state;
}

// A whole number by which the period and the winding can be divided, 1 if there is none up to 8.
int repeats(const model::Parameters& p, double speed, const Shooting& s, const Winding& winding, const VectorXd& unit) {
  for (int k = 8; k > 1; --k) {
    if (std::any_of(winding.begin(), winding.end(), [k](int turns) { return turns % k != 0; })) continue;
    const auto there = states_at(p, speed, s.nodes, s.period, {s.period / k});
    if (there.empty()) continue;
    VectorXd miss = there[0] - s.nodes[0];
    for (int i = 0; i < p.balls; ++i) miss[model::index::phi(i)] -= two_pi * (winding[i] / k);
    if (miss.cwiseQuotient(unit).lpNorm<Eigen::Infinity>() < same_state) return k;
  }
  return 1;
}

}  // namespace

std::optional<Equilibrium> refine_equilibrium(const model::Parameters& p, double speed, const VectorXd& guess) {
  // Levenberg's and Marquardt's step with the damping |f|^2: as fast as Newton's near isolated equilibria and near
  // continua alike, where it tends to the least-norm step (N. Yamashita, M. Fukushima, Computing Suppl. 15 (2001) 239).
  constexpr int most_iterations = 100;
  // Rounding of dz/dt, whose terms are of size speed^2.
  const double target = 1e-14 * (1.0 + speed * speed);
  VectorXd z = guess, rate = model::derivative(p, speed, z.data());
  for (int iteration = 0; iteration < most_iterations && rate.lpNorm<Eigen::Infinity>() > 0.01 * target; ++iteration) {
    if (!rate.allFinite()) return std::nullopt;
    const MatrixXd jacobian = model::jacobian(p, speed, z.data());
    MatrixXd normal = jacobian.transpose() * jacobian;
    // Where the damping has vanished, rounding would fill directions in which the Jacobian is singular.
    normal.diagonal().array() += std::max(rate.squaredNorm(), 1e-14 * normal.trace());
    const VectorXd change = -normal.ldlt().solve(jacobian.transpose() * rate);
    double share = 1.0;
    VectorXd next, next_rate;
    for (; share > 1e-4; share *= 0.5) {
      next = z + share * change;
      next_rate = model::derivative(p, speed, next.data());
      if (next_rate.norm() < rate.norm()) break;
    }
    if (!(share > 1e-4)) break;  // rounding, or no equilibrium near
    z = next;
    rate = next_rate;
  }
  Equilibrium result{z, {}, rate.lpNorm<Eigen::Infinity>()};
  if (!(result.residual < target)) return std::nullopt;
  result.eigenvalues = model::jacobian(p, speed, z.data()).eigenvalues();
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end(), [](const auto& a, const auto& b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
  });
  return result;
}

bool PeriodicOrbit::stable() const {
  for (Index k = 1; k < multipliers.size(); ++k)
    if (!(std::abs(multipliers[k]) < 1.0)) return false;
  return true;
}

std::optional<PeriodicOrbit> refine_orbit(const model::Parameters& p, double speed, const std::vector<VectorXd>& guess,
                                          double period) {
  if (guess.empty() || !(period > 0.0)) return std::nullopt;
  Shooting s;
  s.period = period;
  const int given = static_cast<int>(guess.size());
  s.nodes = given >= fewest_nodes && given <= most_nodes
                ? guess
                : resample(p, speed, guess, period, period, node_count(period));
  if (s.nodes.empty()) return std::nullopt;
  for (int i = 0; i < p.balls; ++i) {  // whole turns off, so that angles keep their digits
    const int phi = model::index::phi(i);
    const double turns = two_pi * std::floor(s.nodes[0][phi] / two_pi);
    for (VectorXd& z : s.nodes) z[phi] -= turns;
  }
  for (;;) {
    OrbitProblem problem(p, speed, s.nodes.size());
    const auto winding = problem.find_winding(s);
    if (!winding || !solve(problem, s) || is_equilibrium(p, speed, s, problem.unit())) return std::nullopt;
    const int k = repeats(p, speed, s, *winding, problem.unit());
    if (k == 1) {
      PeriodicOrbit orbit{s.period, *winding, s.nodes, {}, s.mismatch.lpNorm<Eigen::Infinity>()};
      orbit.multipliers = floquet_multipliers(p, speed, s.nodes, s.arcs);
      return orbit;
    }
    const double once = s.period / k;
    s.nodes = resample(p, speed, s.nodes, s.period, once, node_count(once));
    if (s.nodes.empty()) return std::nullopt;
    s.period = once;
  }
}

std::optional<PeriodicOrbit> refine_orbit(const model::Parameters& p, double speed, const VectorXd& state,
                                          double period) {
  return refine_orbit(p, speed, std::vector<VectorXd>{state}, period);
}

std::vector<VectorXd> sample_orbit(const model::Parameters& p, double speed, const PeriodicOrbit& orbit, int count) {
  return resample(p, speed, orbit.nodes, orbit.period, orbit.period, count);
}

}  // namespace equipoise
