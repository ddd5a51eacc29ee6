// Takes a trajectory to its motion.
//
// The trajectory is followed over stretches, each as long as all before it. After each one three tests follow in order.
// Does it come to rest? Does it come back? (Newton's method then finds the periodic orbit long before the trajectory
// reaches it.) Do its statistics repeat? A steady motion is believed only if the trajectory is seen to approach it or,
// if it has none to approach, goes on as before for as long again.
//
// With a stroboscopic section all tests are made on the section, and all times are whole periods of it.
#include "equipoise/attractors/motions/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "equipoise/attractors/equilibria/continuum_of_equilibria.hpp"
#include "equipoise/attractors/equilibria/equilibria.hpp"
#include "equipoise/attractors/motions/approach.hpp"
#include "equipoise/attractors/motions/motion_description.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/motions/motion_symmetry.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/math/dense.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/linearisation.hpp"

namespace equipoise {

namespace {

// In 4000 time units the second exponent of a torus is zero to 2e-4.
constexpr double clear_zero = 3e-4;

// Of the deviation that dies out slowest; a continuum's zeros are none.
double slowest_rate(const Eigen::VectorXcd& eigenvalues) {
  return std::find_if(eigenvalues.begin(), eigenvalues.end(),
                      [](const auto& value) { return std::abs(value) >= zero_eigenvalue; })
      ->real();
}

// A stable periodic orbit met on the way.
struct KnownOrbit {
  PeriodicOrbit orbit;
  OrbitCurve curve;
};

class SmoothJourney final : public Journey {
 public:
  using Journey::Journey;

 private:
  std::optional<Motion> seen() override {
    auto motion = rest();
    if (!motion) motion = recurrence();
    if (!motion) motion = persistence();
    return motion;
  }

  // Whether everything is so nearly at rest that the trajectory gets nowhere in the time left: neither by its rate of
  // change nor by growth of deviations.
  bool creeps() const override {
    if (on_section() || difference_.length(model::rate(system_, state_)) * patience_ > in_reach) return false;
    return dense::largest_real_part(model::jacobian(system_, state_)) * patience_ < 1.0;
  }

  // A torus that locks comes back only after as many turns of its slower angle as the lock takes of both. Without a
  // second zero exponent it is not quasi-periodic, so returns over much longer times are looked for once patience is
  // over. If none leads to an orbit, the lock is finer than can be followed, and all that can be seen is a torus.
  std::optional<Motion> seen_late() override {
    constexpr double share = 0.5;  // of patience
    constexpr int returns = 16;
    if (on_section() || !locked_ || !is_over() || is_set(stop_)) return std::nullopt;
    const double duration = share * patience_, spacing = sample_spacing(system_, state_);
    std::vector<Eigen::VectorXd> samples;
    if (!travel(end_ = state_, duration, nullptr, &samples)) return std::nullopt;
    elapsed_ += duration;
    state_ = system_.with_angles_reduced(end_);
    std::vector<Return> late = returns_to_last(system_, samples, spacing, difference_, returns, in_reach,
                                               std::numeric_limits<double>::infinity());
    std::reverse(late.begin(), late.end());  // the closest first
    for (const Return& now : late) {
      const auto orbit = find_orbit(system_, state_, now.time, in_reach, stop_);
      if (!orbit || !orbit->stable()) continue;
      const OrbitCurve curve(system_, *orbit);
      const auto distance = [&](const Eigen::VectorXd& z) { return curve.distance(z); };
      if (approaches(orbit->slowest_rate(), distance, 0.0, patience_)) return describe_orbit(system_, *orbit);
    }
    return repeats_ >= 2 ? restless(MotionKind::quasi_periodic, *locked_) : std::nullopt;
  }

  // Follows a copy of the trajectory and says whether it comes closer to a stable motion. `rate`: of the slowest
  // deviation, negative. If the motion is known only up to `blur`, no approach below that is required. `left`: the
  // longest time to follow.
  template <class Distance>
  bool approaches(double rate, const Distance& distance, double blur, double left) {
    ahead_ = 0.0;
    const double first = distance(state_);
    if (first > in_reach || !(rate < 0.0)) return false;
    if (first < std::max(1e-9, blur)) return true;
    const double chunk = whole(std::max(1.0 / -rate, 1.0));
    Eigen::VectorXd z = state_;
    double now = first;
    double& travelled = ahead_;
    // Outside the linear regime the distance may grow for a while. A motion left far behind is not approached again
    // soon.
    for (int k = 0; k < 40 && now < 2.0 * in_reach; ++k) {
      const double duration = std::min(chunk, left);
      if (duration <= 0.5 * section_period_) break;
      if (!travel(z, duration)) return false;
      z = system_.with_angles_reduced(std::move(z));
      left -= duration;
      travelled += duration;
      now = distance(z);
      if (now < reached && now < 0.5 * first) return true;
      if (now < std::max(1e-6, blur)) return true;
    }
    // Out of patience: at least half the decay of linear theory must have been seen.
    return now < 0.1 * in_reach && now < first * std::exp(0.5 * rate * travelled) && travelled * -rate > 0.5;
  }

  template <class Distance>
  bool approaches(double rate, const Distance& distance, double blur = 0.0) {
    return approaches(rate, distance, blur, patience_ - elapsed_);
  }

  std::optional<Motion> continuum() {
    const auto balanced = nearest_balanced(system_, state_, in_reach);
    if (!balanced || !balanced->attracts) return std::nullopt;
    std::optional<BalancedMember> end;
    const auto distance = [&](const Eigen::VectorXd& z) {
      end = nearest_balanced(system_, z, in_reach);
      return end ? difference_.distance(z, end->state) : std::numeric_limits<double>::infinity();
    };
    if (!approaches(balanced->rate, distance) || !end || !end->attracts) return std::nullopt;
    return describe(system_, *end);
  }

  // Near the rest of a continuum of balanced states under gravity, and creeping along it.
  std::optional<Motion> creep() {
    if (!may_creep_balanced() || !ContinuumOfEquilibria::is_of(system_)) return std::nullopt;
    const ContinuumOfEquilibria continuum(system_);
    std::optional<ContinuumMember> end = continuum.destination(state_);
    if (!end || !(end->rate < 0.0)) return std::nullopt;
    const double rate = end->rate;
    // A creeping state lags behind the members that it passes.
    const double lag = end->creep.norm() / -rate;
    const auto distance = [&](const Eigen::VectorXd& z) {
      end = continuum.destination(z);
      return end ? difference_.distance(z, end->centre) : std::numeric_limits<double>::infinity();
    };
    if (!approaches(rate, distance, lag) || !end || !(end->rate < 0.0)) return std::nullopt;
    return describe_creep(system_, end->centre, end->rate);
  }

  std::optional<Motion> rest() {
    // If it moves faster, no equilibrium is near: swings have rates of order one, so the equilibrium is as far away.
    Eigen::VectorXd rate = model::rate(system_, state_);
    if (system_.layout().psi >= 0) rate[system_.layout().psi] = 0.0;
    if (!on_section() && difference_.length(rate) > in_reach) return std::nullopt;
    if (model::balanced_freedom(system_) > 0)
      if (auto motion = continuum()) return motion;
    if (on_section()) return creep();  // all other rest shows as a return on the section
    if (system_.layout().psi >= 0 && std::fabs(system_.speed(state_)) > in_reach)
      return std::nullopt;  // it shows as a return after a turn
    std::optional<Equilibrium> end = refine_equilibrium(system_, state_);
    const auto free = [&] { return free_angles(system_, end->state); };
    if (!end || !attracts(end->eigenvalues, free())) return std::nullopt;
    // Each state of a continuum ends in a member of its own.
    const bool searched = free() > 0;
    const auto distance = [&](const Eigen::VectorXd& z) {
      if (searched) end = refine_equilibrium(system_, z);
      return end ? difference_.distance(z, end->state) : std::numeric_limits<double>::infinity();
    };
    if (!approaches(slowest_rate(end->eigenvalues), distance) || !end || !attracts(end->eigenvalues, free()))
      return std::nullopt;
    return describe_equilibrium(system_, *end);
  }

  std::optional<Motion> recurrence() {
    const auto accepted = [&](const KnownOrbit& known) {
      return approaches(known.orbit.slowest_rate(), [&](const Eigen::VectorXd& z) { return known.curve.distance(z); });
    };
    for (const KnownOrbit& known : orbits_)
      if (accepted(known)) return describe_orbit(system_, known.orbit);
    for (const Return& now : returns_to_last(system_, samples_, spacing(), difference_, most_returns, in_reach)) {
      const auto orbit = orbit_of(now);
      if (!orbit || !orbit->stable()) continue;
      orbits_.push_back({*orbit, {system_, *orbit}});
      if (accepted(orbits_.back())) return describe_orbit(system_, *orbit);
    }
    return std::nullopt;
  }

  std::optional<PeriodicOrbit> orbit_of(const Return& now) {
    if (!on_section()) return worth_trying(now) ? find_orbit(system_, state_, now.time, in_reach, stop_) : std::nullopt;
    const long sections = std::lround(now.time / section_period_);
    return refine_orbit(system_, std::vector<Eigen::VectorXd>(samples_.end() - 1 - sections, samples_.end() - 1),
                        now.time, in_reach, stop_);
  }

  // After Newton's method fails from a return, it is tried again once the return is twice as close. That happens on the
  // way to a periodic motion, but not on a torus.
  bool worth_trying(const Return& now) {
    constexpr double same_time = 0.02;
    for (Return& before : tried_) {
      if (std::fabs(before.time - now.time) > same_time * now.time) continue;
      if (now.distance > 0.5 * before.distance) return false;
      before = now;
      return true;
    }
    tried_.push_back(now);
    return true;
  }

  // Whether the trajectory was here before: within half of the furthest distance that it has gone since. A creeping one
  // repeats its statistics and has no positive exponent, but never returns.
  bool comes_back() const {
    if (samples_.empty()) return false;
    double farthest = 0.0;
    bool back = false;
    for (auto state = samples_.rbegin(); state != samples_.rend(); ++state) {
      const double now = difference_.distance(*state, state_);
      if (now > farthest) {
        farthest = now;
        back = false;
      }
      back = back || now < 0.5 * farthest;
    }
    return back;
  }

  // Under gravity a continuum of balanced states leaves a motion along it that never comes back.
  bool may_creep_balanced() const { return on_section() && p_.gravity != 0.0 && p_.balls > 2; }

  bool creeps_balanced(const Motion& motion) const {
    if (!may_creep_balanced() || motion.kind != MotionKind::quasi_periodic) return false;
    const auto creeps = [&](double drift) { return std::fabs(drift) * motion.duration < 0.5 * pi; };
    return std::all_of(motion.drift.begin(), motion.drift.begin() + p_.balls, creeps) &&
           relaxes_to_balance(system_, motion.state);
  }

  // Lyapunov exponents from here on, and the kind that they imply; empty if the motion does not last.
  std::optional<std::vector<double>> exponents_of(MotionKind& kind) {
    // A shift in time has exponent 0; on a stroboscopic section there is no such shift.
    const std::size_t next = on_section() ? 0 : 1;
    const int count = std::min<int>(4, system_.dimension());
    double duration = std::max(last_.duration, 4000.0);
    std::vector<double> exponents = lyapunov_exponents(system_, state_, duration, count, stop_);
    if (exponents.size() < 2) return std::nullopt;
    // A slow way into a periodic motion long looks like a torus, so exponents that are not clearly zero are measured
    // again.
    if (exponents[0] < 8.0 / duration && exponents[next] < -clear_zero && exponents[next] > -8.0 / duration) {
      duration *= 8.0;
      exponents = lyapunov_exponents(system_, state_, duration, count, stop_);
      if (exponents.size() < 2) return std::nullopt;
      periodic_ = duration >= patience_ && exponents[next] < -8.0 / duration;
    }
    const double zero = 8.0 / duration;
    locked_.reset();
    if (exponents[0] > zero)
      kind = MotionKind::chaotic;
    else if (exponents[0] > -zero && exponents[next] > -zero)
      kind = MotionKind::quasi_periodic;
    else {
      if (exponents[0] > -zero) locked_ = exponents;
      return std::nullopt;
    }
    return exponents;
  }

  // The motion of this kind that the trajectory is on.
  std::optional<Motion> restless(MotionKind kind, const std::vector<double>& exponents) {
    Motion motion;
    motion.kind = kind;
    motion.speed = system_.speed(state_);
    motion.depends_on_angle = !system_.autonomous();
    // A torus is measured afresh: the stretch that showed it may have begun before balls had quite joined.
    MotionStatistics fresh;
    MotionStatistics& measured = kind == MotionKind::quasi_periodic ? fresh : last_;
    const double duration = whole(last_.duration);
    if (kind == MotionKind::quasi_periodic) {
      end_ = state_;
      if (!travel(end_, duration, &fresh)) return std::nullopt;
    }
    // Slips of chaotic motion average out like the square root of time, and slow beats of a torus even out; a few more
    // stretches may settle whether they do.
    constexpr double longest = 16.0;
    while (!drifts_are_known(p_, measured, motion) && measured.duration < longest * duration)
      if (!travel(end_, duration, &measured)) return std::nullopt;
    motion.state = system_.with_angles_reduced(end_);
    motion.exponents = exponents;
    motion.stable = true;
    describe_statistics(system_, measured, motion);
    motion.balanced = creeps_balanced(motion);
    motion.copies = motion.balanced ? 1 : count_copies(system_, motion);
    return motion;
  }

  std::optional<Motion> persistence() {
    const bool tight = statistics_repeat(0.01, 0.005), loose = statistics_repeat(0.1, 0.05);
    repeats_ = tight ? repeats_ + 1 : 0;
    ahead_ = 0.0;
    // Chaos that drifts slowly may not come back within the samples.
    const bool returns = may_creep_balanced() || comes_back();
    if (!returns && !is_over()) return std::nullopt;
    if (last_.duration < 1000.0 || !(repeats_ >= 2 || (is_over() && loose))) return std::nullopt;
    if (periodic_ || (chaotic_ && !is_over())) return std::nullopt;
    MotionKind kind = MotionKind::chaotic;
    const auto exponents = exponents_of(kind);
    chaotic_ = exponents && kind == MotionKind::chaotic;
    if (!exponents || (chaotic_ ? !is_over() : repeats_ < 2 || !returns)) return std::nullopt;
    return restless(kind, *exponents);
  }

  std::vector<KnownOrbit> orbits_;  // met so far
  std::vector<Return> tried_;       // Newton's method failed from these returns
  // What the last exponents said. They are measured over a longer time than a journey, so a periodic motion stays one.
  // Chaos may end, and is believed only when patience is over.
  bool periodic_ = false, chaotic_ = false;
  // Its exponents if the last ones were those of a periodic motion, though its statistics repeat like a torus's.
  std::optional<std::vector<double>> locked_;
};

}  // namespace

Approach settle(const model::System& system, const Eigen::VectorXd& state, double patience, const StopFlag* stop) {
  if (!system.smooth()) return settle_with_events(system, state, patience, stop);
  return SmoothJourney(system, state, patience, stop).settle();
}

std::optional<Motion> motion_from(const model::System& system, const Eigen::VectorXd& state, double patience,
                                  const StopFlag* stop) {
  return settle(system, state, patience, stop).motion;
}

}  // namespace equipoise
