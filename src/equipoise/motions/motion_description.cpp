// Describing motions: statistics, what the balls do, symmetry.
#include "equipoise/motions/motion_description.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <functional>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/motions/motion_symmetry.hpp"

namespace equipoise {

namespace {

// Refined orbits are measured at this tolerance.
constexpr double tolerance = 1e-12;
// Balls whose angles differ by less all along move as one: above the errors of a refined orbit (1e-10), below any
// distance that exchange could show.
constexpr double coincident = 1e-6;

// Drifts of chaotic motion below this part of the rotor's speed are not told from none.
constexpr double least_drift = 0.01;

Drift drift_of(const AngleRecord& angle, const Motion& motion) {
  const bool regular = motion.kind != MotionKind::chaotic;
  return drift_of(mean_rate(angle, regular), regular, least_drift * std::fabs(motion.speed));
}

void group_by_drift(const model::Parameters& p, const MotionStatistics& statistics, Motion& motion) {
  const bool exact = motion.kind == MotionKind::periodic;
  int groups = 1;
  for (int k = 0; k < p.balls; ++k) {
    int& group = motion.drift_group[k];
    group = -1;
    if (exact ? motion.winding[k] == 0 : drift_of(statistics.angle[k], motion) == Drift::none) group = 0;
    for (int i = 0; i < k && group < 0; ++i) {
      if (motion.drift_group[i] == 0) continue;
      const bool same = exact ? motion.winding[i] == motion.winding[k]
                              : drift_of(statistics.angle[i] - statistics.angle[k], motion) != Drift::some;
      if (same) group = motion.drift_group[i];
    }
    if (group < 0) group = groups++;
  }
}

}  // namespace

void describe_pairs(const model::Parameters& p, const MotionStatistics& statistics, Motion& motion) {
  const int n = p.balls;
  const auto as_one = [&](int i, int k) { return statistics.pair[i][k].farthest < coincident; };
  int clusters = 0;
  for (int k = 0; k < n; ++k) {
    motion.cluster[k] = -1;
    for (int i = 0; i < k && motion.cluster[k] < 0; ++i)
      if (as_one(i, k)) motion.cluster[k] = motion.cluster[i];
    if (motion.cluster[k] < 0) motion.cluster[k] = clusters++;
  }
  bool opposite = false;
  for (int i = 0; i < n; ++i) {
    for (int k = i + 1; k < n; ++k) {
      if (motion.cluster[i] == motion.cluster[k]) continue;
      opposite = opposite || statistics.pair[i][k].passed_pi > 0;
    }
  }
  if (n == 2 && motion.drift_group[0] != 0 && motion.drift_group[0] == motion.drift_group[1]) {
    const double turns = motion.kind == MotionKind::periodic
                             ? std::abs(motion.winding[0])
                             : 0.5 * std::fabs(statistics.turned[0] + statistics.turned[1]) / two_pi;
    motion.oppositions_per_turn = static_cast<double>(statistics.pair[0][1].passed_pi) / turns;
  }
  // Balls spread all around the race (three, a third of a turn apart) pass no opposite either, but no arc of half a
  // turn holds the angles between them.
  bool one_side = clusters > 1 && !opposite && motion.kind != MotionKind::equilibrium;
  const auto ahead = [&](int i) {
    return wrapped(motion.state[model::index::phi(i)] - motion.state[model::index::phi(0)]);
  };
  for (int i = 0; one_side && i < n; ++i)
    for (int k = 0; k < i; ++k) one_side = one_side && std::fabs(ahead(i) - ahead(k)) < pi;
  motion.together = one_side;
}

Eigen::VectorXd with_angles_reduced(const model::Parameters& p, Eigen::VectorXd state) {
  for (int i = 0; i < p.balls; ++i) {
    double& phi = state[model::index::phi(i)];
    phi = wrapped_positive(phi);
  }
  return state;
}

void describe_statistics(const model::Parameters& p, const MotionStatistics& statistics, Motion& motion) {
  motion.duration = statistics.duration;
  motion.r_min = statistics.r_min;
  motion.r_mean = statistics.r_mean();
  motion.r_max = statistics.r_max;
  for (int i = 0; i < p.balls; ++i) {
    motion.drift[i] = motion.kind == MotionKind::periodic
                          ? two_pi * motion.winding[i] / motion.period
                          : mean_rate(statistics.angle[i], motion.kind != MotionKind::chaotic).rate;
    motion.rate_min[i] = statistics.rate_min[i];
    motion.rate_max[i] = statistics.rate_max[i];
  }
  group_by_drift(p, statistics, motion);
  describe_pairs(p, statistics, motion);
}

bool drifts_are_known(const model::Parameters& p, const MotionStatistics& statistics, const Motion& motion) {
  for (int i = 0; i < p.balls; ++i) {
    if (drift_of(statistics.angle[i], motion) == Drift::unknown) return false;
    for (int k = 0; k < i; ++k)
      if (drift_of(statistics.angle[i] - statistics.angle[k], motion) == Drift::unknown) return false;
  }
  return true;
}

int continuum_dimension(const model::Parameters& p) {
  if (model::balanced_states(p).kind != model::BalancedStates::Kind::family) return 0;
  return std::max(p.balls - 2, 1);
}

bool attracts(const Eigen::VectorXcd& eigenvalues, int zeros_allowed) {
  int zeros = 0;
  for (const std::complex<double>& value : eigenvalues) {
    if (std::abs(value) < zero_eigenvalue)
      ++zeros;
    else if (value.real() >= 0.0)
      return false;
  }
  return zeros <= zeros_allowed;
}

const char* name_of(MotionKind kind) {
  switch (kind) {
    case MotionKind::equilibrium:
      return "equilibrium";
    case MotionKind::periodic:
      return "periodic";
    case MotionKind::quasi_periodic:
      return "quasi-periodic";
    case MotionKind::chaotic:
      return "chaotic";
    default:
      return "measured";
  }
}

Motion describe_equilibrium(const model::Parameters& p, double speed, const Equilibrium& equilibrium) {
  Motion motion;
  motion.kind = MotionKind::equilibrium;
  motion.speed = speed;
  motion.state = with_angles_reduced(p, equilibrium.state);
  motion.spectrum = equilibrium.eigenvalues;
  for (const std::complex<double>& value : equilibrium.eigenvalues) motion.exponents.push_back(value.real());
  motion.residual = equilibrium.residual;
  motion.r_min = motion.r_mean = motion.r_max = std::hypot(motion.state[0], motion.state[1]);
  MotionStatistics statistics;
  for (int i = 0; i < p.balls; ++i)
    for (int k = i + 1; k < p.balls; ++k)
      statistics.pair[i][k].begin(motion.state[model::index::phi(i)] - motion.state[model::index::phi(k)]);
  describe_pairs(p, statistics, motion);
  motion.stable = attracts(motion.spectrum, is_balanced_continuum(p, motion) ? continuum_dimension(p) : 0);
  motion.copies = count_copies(p, motion);
  return motion;
}

Motion describe_orbit(const model::Parameters& p, double speed, const PeriodicOrbit& orbit) {
  Motion motion;
  motion.kind = MotionKind::periodic;
  motion.speed = speed;
  motion.state = with_angles_reduced(p, orbit.nodes.front());
  motion.period = orbit.period;
  motion.winding = orbit.winding;
  motion.orbit = orbit;
  motion.spectrum = orbit.multipliers;
  for (const std::complex<double>& value : orbit.multipliers)
    motion.exponents.push_back(std::log(std::max(1e-300, std::abs(value))) / orbit.period);
  std::sort(motion.exponents.begin(), motion.exponents.end(), std::greater<>());
  motion.stable = orbit.stable();
  motion.residual = orbit.residual;
  MotionStatistics statistics;
  const double arc = orbit.period / static_cast<double>(orbit.nodes.size());
  for (Eigen::VectorXd state : orbit.nodes)  // arc by arc: an unstable orbit would not be followed for long
    follow(p, speed, state, arc, tolerance, &statistics);
  describe_statistics(p, statistics, motion);
  motion.half_period_exchange = is_half_period_exchange(p, speed, orbit);
  motion.copies = count_copies(p, motion);
  return motion;
}

}  // namespace equipoise
