// Describes motions: statistics, what the balls do, symmetry.
#include "equipoise/attractors/motions/motion_description.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <functional>
#include <limits>

#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

// Tolerance for measuring refined orbits.
constexpr double description_tolerance = 1e-12;
// Balls whose angles always differ by less move as one. Above the errors of a refined orbit (1e-10), below any distance
// that an exchange could show.
constexpr double coincident = 1e-6;

// Fraction of the rotor's speed below which a drift of chaotic motion counts as none.
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
  // Balls spread around the whole race (three, a third of a turn apart) pass no opposite places either. But then no arc
  // of half a turn holds the angles between them.
  bool one_side = clusters > 1 && !opposite && motion.kind != MotionKind::equilibrium;
  const auto ahead = [&](int i) {
    return wrapped(motion.state[model::index::phi(i)] - motion.state[model::index::phi(0)]);
  };
  for (int i = 0; one_side && i < n; ++i)
    for (int k = 0; k < i; ++k) one_side = one_side && std::fabs(ahead(i) - ahead(k)) < pi;
  motion.together = one_side;
}

void describe_drive(const model::System& system, const MotionStatistics& statistics, Motion& motion) {
  motion.speed = system.speed();
  if (system.prescribed()) return;
  const double time = statistics.duration;
  const DriveStatistics& d = statistics.drive;
  motion.speed = statistics.speed_mean();
  motion.motor = MotorLoad{system.drive(),           d.speed_min,   d.speed_max,
                           d.torque_integral / time, d.work / time, d.support_work / time};
}

}  // namespace

void describe_statistics(const model::System& system, const MotionStatistics& statistics, Motion& motion) {
  const model::Parameters& p = system.parameters();
  describe_drive(system, statistics, motion);
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

namespace {

// For a motion at rest in the rotating frame: only the angles between balls.
void describe_rest(const model::Parameters& p, Motion& motion) {
  MotionStatistics statistics;
  for (int i = 0; i < p.balls; ++i)
    for (int k = i + 1; k < p.balls; ++k)
      statistics.pair[i][k].begin(motion.state[model::index::phi(i)] - motion.state[model::index::phi(k)]);
  describe_pairs(p, statistics, motion);
}

// Whether an orbit of a system that depends on the rotor's angle is an equilibrium. Under gravity nothing rests. Where
// something rests, its components are zero to rounding.
bool is_at_rest(const model::System& system, const PeriodicOrbit& orbit) {
  constexpr double at_rest = 1e-9;
  const int n = system.balls();
  const Eigen::VectorXd& z = orbit.nodes.front();
  return !system.autonomous() && system.parameters().gravity == 0.0 && z.head(4).lpNorm<Eigen::Infinity>() <= at_rest &&
         (!system.tilts() || z.tail(4).lpNorm<Eigen::Infinity>() <= at_rest) &&
         z.segment(model::index::q(0, n), n).lpNorm<Eigen::Infinity>() <= at_rest;
}

// For a motion with constant speed.
void describe_steady_drive(const model::System& system, Motion& motion) {
  motion.speed = system.speed(motion.state);
  if (system.prescribed()) return;
  const auto& damping = system.parameters().damping;
  const double torque = system.torque(motion.state), power = torque * motion.speed;
  double supports = 0.5 * (damping[0] + damping[1]) * motion.state.segment(2, 2).squaredNorm();
  if (const int tilt = system.layout().tilt; tilt >= 0)
    supports += model::power_taken_from_tilt(system.parameters(), 0.0, motion.state.data(), &motion.state[tilt]);
  motion.motor = MotorLoad{system.drive(), motion.speed, motion.speed, torque, power, supports};
}

}  // namespace

double r_at_rest(const model::System& system, const Eigen::VectorXd& state) {
  const int place = system.layout().psi;
  const auto rest = place < 0 ? std::array{0.0, 0.0} : model::rest_position(system.parameters(), state[place]);
  return std::hypot(state[0] - rest[0], state[1] - rest[1]);
}

model::System system_of(const model::Parameters& p, const Motion& motion) {
  return motion.motor ? model::System(p, motion.motor->drive) : model::System(p, motion.speed);
}

Motion motion_at_rest(const model::System& system, const Equilibrium& equilibrium) {
  Motion motion;
  motion.kind = MotionKind::equilibrium;
  motion.state = system.with_angles_reduced(equilibrium.state);
  describe_steady_drive(system, motion);
  describe_rest(system.parameters(), motion);
  motion.spectrum = equilibrium.eigenvalues;
  for (const std::complex<double>& value : equilibrium.eigenvalues) motion.exponents.push_back(value.real());
  motion.residual = equilibrium.residual;
  motion.r_min = motion.r_mean = motion.r_max = r_at_rest(system, motion.state);
  return motion;
}

Motion describe_equilibrium(const model::System& system, const Equilibrium& equilibrium) {
  Motion motion = motion_at_rest(system, equilibrium);
  motion.stable = attracts(motion.spectrum, is_balanced(system, motion) ? model::balanced_freedom(system)
                                                                        : free_angles(system, motion.state));
  motion.copies = count_copies(system, motion);
  return motion;
}

Motion motion_on_orbit(const model::System& system, const PeriodicOrbit& orbit, const Eigen::VectorXcd& spectrum) {
  Motion motion;
  motion.kind = MotionKind::periodic;
  motion.state = system.with_angles_reduced(orbit.nodes.front());
  describe_steady_drive(system, motion);
  motion.orbit = orbit;
  motion.spectrum = spectrum;
  for (const std::complex<double>& value : spectrum)
    motion.exponents.push_back(std::log(std::max(1e-300, std::abs(value))) / orbit.period);
  std::sort(motion.exponents.begin(), motion.exponents.end(), std::greater<>());
  motion.residual = orbit.residual;
  const int turns = system.layout().psi < 0 ? 0 : std::abs(orbit.winding[system.balls()]);
  motion.depends_on_angle = orbit.imposed || turns > 0;
  motion.sections = orbit.imposed ? static_cast<int>(orbit.nodes.size()) : turns;
  return motion;
}

Motion describe_orbit(const model::System& system, const PeriodicOrbit& orbit) {
  const bool rests = is_at_rest(system, orbit);
  Motion motion = motion_on_orbit(system, orbit, rests ? orbit.decays() : orbit.multipliers);
  if (rests) motion.kind = MotionKind::equilibrium;
  motion.stable = contracts(orbit.decays(), rests ? model::balanced_freedom(system) : 0);
  if (rests) {
    describe_rest(system.parameters(), motion);
  } else {
    motion.period = orbit.period;
    motion.winding = orbit.winding;
    MotionStatistics statistics;
    const double arc = orbit.period / static_cast<double>(orbit.nodes.size());
    for (Eigen::VectorXd state : orbit.nodes)  // arc by arc: an unstable orbit cannot be followed for long
      follow(system, state, arc, description_tolerance, &statistics);
    describe_statistics(system, statistics, motion);
  }
  if (motion.depends_on_angle)
    motion.balanced = rests || leads_to_balance(system, orbit);
  else
    motion.half_period_exchange = is_half_period_exchange(system, orbit);
  motion.copies = count_copies(system, motion);
  return motion;
}

Motion describe_creep(const model::System& system, const Eigen::VectorXd& state, double rate) {
  constexpr int sections = 100;
  constexpr double creep_tolerance = 1e-9;
  Motion motion;
  motion.kind = MotionKind::quasi_periodic;
  motion.depends_on_angle = motion.balanced = motion.stable = true;
  motion.state = system.with_angles_reduced(state);
  motion.exponents = {0.0, rate};
  MotionStatistics statistics;
  Eigen::VectorXd z = state;
  follow(system, z, sections * system.section_period(), creep_tolerance, &statistics);
  describe_statistics(system, statistics, motion);
  motion.drift.fill(0.0);
  motion.drift_group.fill(0);
  return motion;
}

std::optional<Motion> refined_motion(const model::System& system, const Motion& guess, const StopFlag* stop) {
  // Motions change if the equations begin or cease to depend on the rotor's angle.
  if (guess.state.size() != system.dimension()) return std::nullopt;
  std::optional<Motion> motion;
  if (guess.orbit.nodes.empty()) {
    if (system.section() == model::Section::stroboscopic) return std::nullopt;
    if (const auto found = refine_equilibrium(system, guess.state)) motion = describe_equilibrium(system, *found);
  } else if (guess.orbit.imposed == (system.section() == model::Section::stroboscopic)) {
    const auto found =
        refine_orbit(system, guess.orbit.nodes, guess.orbit.period, std::numeric_limits<double>::infinity(), stop);
    if (found) motion = describe_orbit(system, *found);
  }
  return motion && stays_clear(system, *motion) ? motion : std::nullopt;
}

}  // namespace equipoise
