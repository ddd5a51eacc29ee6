// Takes a trajectory with events to its motion, by recurrence.
//
// As in motion.cpp stretches double, and a motion is believed once the trajectory is seen to approach it. Newton's
// method works on the return map. If it finds no orbit, windows that repeat themselves identify the motion.
#include "equipoise/attractors/motions/approach.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "equipoise/attractors/equilibria/stuck.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/attractors/periodic_orbits/return_map.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"

namespace equipoise {

namespace {

// Multipliers of the return map are good to 1e-6. With dry friction, one this close to 1 counts as 1.
constexpr double neutral = 1e-3;

// All multipliers attract, except those at 1 of balls that may as well stick a little further on.
bool orbit_attracts(const model::System& system, const PeriodicOrbit& orbit) {
  const Eigen::VectorXcd decays = orbit.decays();
  return std::all_of(decays.begin(), decays.end(), [&](std::complex<double> m) {
    return std::abs(m) < 1.0 || (system.events().stick && std::abs(m - 1.0) < neutral);
  });
}

// States of an orbit, dense enough for chords between them.
class OrbitTrack {
 public:
  OrbitTrack(const model::System& system, const PeriodicOrbit& orbit) : difference_(system) {
    states_ = orbit.nodes;
    if (orbit.imposed) return;
    constexpr double finer = 0.25;
    MotionStatistics spacing;
    spacing.spacing = finer * sample_spacing(system, orbit.nodes.front());
    EventLog log;
    Eigen::VectorXd z = orbit.nodes.front();
    follow_events(system, z, orbit.period, follow_tolerance, log, &spacing, &states_);
    states_.push_back(z);
  }

  double distance(const Eigen::VectorXd& state) const {
    double least = std::numeric_limits<double>::infinity();
    if (states_.size() == 1) return difference_.distance(states_[0], state);
    for (std::size_t k = 0; k + 1 < states_.size(); ++k) {
      const Eigen::VectorXd along = difference_(states_[k + 1], states_[k]), away = difference_(state, states_[k]);
      const double share = std::clamp(away.dot(along) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
      least = std::min(least, (away - share * along).norm());
    }
    return least;
  }

 private:
  StateDifference difference_;
  std::vector<Eigen::VectorXd> states_;
};

class EventJourney final : public Journey {
 public:
  using Journey::Journey;

 private:
  std::optional<Motion> seen() override {
    auto motion = stuck();
    if (!motion) motion = smooth();
    if (!motion) motion = rest();
    if (!motion) motion = recurrence();
    if (!motion) motion = persistence();
    return motion;
  }

  std::optional<Motion> stuck() {
    const auto end = stuck_for_good(system_, state_, 0.0);
    return end ? std::optional(describe_stuck(system_, *end)) : std::nullopt;
  }

  // A motion without any more contact.
  std::optional<Motion> smooth() {
    const bool free = log_.count == 0 && !any_joined(log_.end, p_.balls);
    if (system_.events().stick || !free) return std::nullopt;
    const model::System passing = without_events(system_);
    Approach settling = equipoise::settle(passing, state_, std::max(patience_ - elapsed_, elapsed_), stop_);
    if (!settling.motion || !settling.motion->stable || !stays_clear(system_, *settling.motion)) return std::nullopt;
    // No contact before it is reached, either.
    Eigen::VectorXd z = state_;
    EventLog log;
    if (!travel(z, whole(settling.time), nullptr, nullptr, &log) || log.count > 0) return std::nullopt;
    ahead_ = settling.time;
    return settling.motion;
  }

  // Follows a copy of the trajectory, which should come closer to a stable motion. `rate`: of its slowest deviation,
  // negative; 0 if deviations vanish at once.
  bool approaches(double rate, double least, const std::function<double(const Eigen::VectorXd&)>& distance) {
    ahead_ = 0.0;
    const double first = distance(state_);
    if (!(first < in_reach)) return false;
    if (first < 1e-7) return true;
    const double chunk = whole(std::max({rate < 0.0 ? 1.0 / -rate : 0.0, least, 1.0}));
    Eigen::VectorXd z = state_;
    double now = first;
    for (int k = 0; k < 40 && now < 2.0 * in_reach && elapsed_ + ahead_ + chunk <= 2.0 * patience_; ++k) {
      if (!travel(z, chunk)) return false;
      z = system_.with_angles_reduced(std::move(z));
      ahead_ += chunk;
      now = distance(z);
      if (now < 1e-6 || (now < reached && now < 0.5 * first)) return true;
    }
    return false;
  }

  std::optional<Motion> rest() {
    if (on_section()) return std::nullopt;
    const auto at = refine_mode_equilibrium(system_, state_);
    if (!at || !(at->eigenvalues[0].real() < zero_eigenvalue)) return std::nullopt;
    const auto distance = [&](const Eigen::VectorXd& z) { return difference_.distance(z, at->state); };
    double rate = -1e300;
    for (const auto& value : at->eigenvalues)
      if (value.real() < -zero_eigenvalue) rate = std::max(rate, value.real());
    if (!approaches(rate, 0.0, distance)) return std::nullopt;
    Motion motion = motion_at_rest(system_, *at);
    motion.stable = motion.eventful = true;
    motion.mode = mode_at(system_, motion.state);
    return motion;
  }

  std::optional<Motion> recurrence() {
    for (const Return& now : returns_to_last(system_, samples_, spacing(), difference_, most_returns, in_reach)) {
      const auto orbit = refine_return(system_, state_, whole(now.time), in_reach);
      if (!orbit || !orbit_attracts(system_, *orbit)) continue;
      const OrbitTrack track(system_, *orbit);
      double rate = 0.0;
      for (const auto& m : orbit->decays())
        if (std::abs(m - 1.0) > neutral && std::abs(m) > 1e-3)
          rate = std::max(rate == 0.0 ? -1e300 : rate, std::log(std::abs(m)) / orbit->period);
      if (!approaches(rate, orbit->period, [&](const Eigen::VectorXd& z) { return track.distance(z); })) continue;
      return describe(*orbit);
    }
    return std::nullopt;
  }

  Motion describe(const PeriodicOrbit& orbit) {
    Motion motion = motion_on_orbit(system_, orbit, orbit.multipliers);
    motion.period = orbit.period;
    motion.winding = orbit.winding;
    if (orbit.imposed) motion.sections = static_cast<int>(std::lround(orbit.period / section_period_));
    MotionStatistics statistics;
    EventLog log;
    Eigen::VectorXd z = motion.state;
    if (on_section())
      travel(z, orbit.period, &statistics, nullptr, &log);
    else
      follow_events(system_, z, orbit.period, 1e-12, log, &statistics);
    describe_statistics(system_, statistics, motion);
    const auto decays = orbit.decays();
    motion.set_valued = system_.events().stick && std::any_of(decays.begin(), decays.end(), [](const auto& m) {
                          return std::abs(m - 1.0) < neutral;
                        });
    with_events(log, motion);
    return motion;
  }

  void with_events(const EventLog& log, Motion& motion) const {
    motion.stable = motion.eventful = true;
    motion.mode = log.begin;
    constexpr std::size_t most = 100;
    const std::size_t first = log.events.size() > most ? log.events.size() - most : 0;
    motion.events.assign(log.events.begin() + static_cast<std::ptrdiff_t>(first), log.events.end());
    capture_those_that_creep(motion);
    const auto captured = [](int group) { return group == 0; };
    const bool all_captured = std::all_of(motion.drift_group.begin(), motion.drift_group.begin() + p_.balls, captured);
    motion.balanced = all_captured && motion.depends_on_angle && halves_the_shaking(p_, motion.speed, motion.r_mean);
  }

  // Gravity or friction may let resting balls creep. Balls that turned by less than a quarter turn in all that was seen
  // do not drift.
  void capture_those_that_creep(Motion& motion) const {
    if (motion.kind == MotionKind::periodic || motion.kind == MotionKind::chaotic) return;
    for (int i = 0; i < p_.balls; ++i)
      if (std::fabs(motion.drift[i]) * motion.duration > 0.5 * pi) return;
    motion.drift.fill(0.0);
    motion.drift_group.fill(0);
    motion.set_valued = true;
  }

  // A motion that neither rests nor comes back, and goes on as before for as long again.
  std::optional<Motion> persistence() {
    if (previous_.duration == 0.0 || last_.duration < 1000.0) return std::nullopt;
    const bool tight = statistics_repeat(0.01, 0.005), loose = statistics_repeat(0.1, 0.05);
    repeats_ = tight ? repeats_ + 1 : 0;
    if (!(repeats_ >= 2 || (is_over() && loose))) return std::nullopt;
    Motion motion;
    const double growth = separation_rate();
    const double zero = 8.0 / last_.duration;
    motion.kind = growth > zero ? MotionKind::chaotic : MotionKind::quasi_periodic;
    motion.speed = system_.speed(state_);
    motion.depends_on_angle = !system_.autonomous();
    motion.state = system_.with_angles_reduced(end_);
    motion.exponents = {growth};
    describe_statistics(system_, last_, motion);
    with_events(log_, motion);
    return motion;
  }

  // The rate at which two neighbours part, when one is brought back towards the other repeatedly (Benettin).
  double separation_rate() const {
    constexpr double apart = 1e-7;
    const double step = whole(5.0), duration = std::min(last_.duration, 2000.0);
    Eigen::VectorXd a = state_, b = state_, push = Eigen::VectorXd::Zero(a.size());
    push.head(4).setConstant(0.5);
    for (int i = 0; i < p_.balls; ++i) push[model::index::phi(i)] = 1.0 / (2.0 + i);
    b += apart * push.cwiseProduct(system_.scale()) / push.norm();
    double sum = 0.0, time = 0.0;
    for (int k = 0; time < duration; ++k) {
      const auto next = after(system_, a, step), beside = after(system_, b, step);
      if (!next || !beside) return 0.0;
      const double distance = std::max(difference_.distance(*next, *beside), 1e-14);
      a = *next;
      b = a + (*beside - a) * (apart / distance);
      if (k < 4) continue;  // the difference first turns into the growing direction
      sum += std::log(distance / apart);
      time += step;
    }
    return sum / time;
  }
};

}  // namespace

bool stays_clear(const model::System& system, const Motion& motion) {
  const model::Parameters& p = system.parameters();
  if (!p.balls_collide()) return true;
  if (!(model::least_gap(p, &motion.state[model::index::phi(0)]) > 0.0)) return false;
  if (motion.kind == MotionKind::equilibrium) return true;
  // Deviations from an unstable motion grow, and balls may touch after a while.
  const double once = motion.kind == MotionKind::periodic ? motion.period : std::max(motion.duration, first_stretch);
  Eigen::VectorXd z = motion.state;
  EventLog log;
  return follow_events(system, z, once, follow_tolerance, log) == IntegrationStatus::done && log.count == 0;
}

model::System without_events(const model::System& system) {
  model::Parameters p = system.parameters();
  p.contact_angle = 0.0;
  p.rolling.fill(0.0);
  p.stiction.fill(0.0);
  return {p, system.drive()};
}

Approach settle_with_events(const model::System& system, const Eigen::VectorXd& state, double patience,
                            const StopFlag* stop) {
  return EventJourney(system, state, patience, stop).settle();
}

}  // namespace equipoise
