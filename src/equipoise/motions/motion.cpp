// From a trajectory to the motion it settles on.
//
// The trajectory is followed over stretches, each as long as all before it together. After every stretch it is asked,
// in this order: does it come to rest, does it come back (then Newton's method finds the periodic orbit long before the
// trajectory reaches it), do its statistics repeat themselves. A steady motion is only believed when the trajectory is
// seen to approach it, or, if it has none to approach, when it goes on as before for as long again.
#include "equipoise/motions/motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "equipoise/base/angles.hpp"
#include "equipoise/math/dense.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/motions/motion_statistics.hpp"
#include "equipoise/motions/motion_symmetry.hpp"
#include "equipoise/motions/settling.hpp"
#include "equipoise/motions/strobed_motion.hpp"
#include "equipoise/orbits/recurrence.hpp"

namespace equipoise {

namespace {

// Trajectories are followed at a tolerance that leaves r true to 1e-8.
constexpr double follow_tolerance = 1e-9;
// The first question is asked after about this time, the longest a quick attractor takes to pull a start in.
constexpr double first_stretch = 100.0;
// Returns are looked for within the last part of a stretch: longer than any period met (pair drift, under 300).
constexpr double longest_memory = 1200.0;
constexpr int most_returns = 6;
// A trajectory this close to a stable motion, in natural sizes, and still approaching has reached it.
constexpr double reached = 1e-3;
// Tori show their second exponent as zero to 2e-4 in 4000 time units.
constexpr double clear_zero = 3e-4;
// Farther than this from a stable motion nothing is concluded yet.
constexpr double in_reach = 0.5;

// The member of the continuum nearest to `state`, described as an equilibrium.
std::optional<Equilibrium> nearest_of_continuum(const model::Parameters& p, double speed,
                                                const Eigen::VectorXd& state) {
  double phi[model::max_balls];
  for (int i = 0; i < p.balls; ++i) phi[i] = state[model::index::phi(i)];
  if (!model::project_to_balanced(p, phi)) return std::nullopt;
  Equilibrium result;
  result.state = model::centred_state(p, phi);
  result.eigenvalues = dense::eigenvalues(model::jacobian(p, speed, result.state.data()));
  std::sort(result.eigenvalues.begin(), result.eigenvalues.end(),
            [](const auto& a, const auto& b) { return a.real() > b.real(); });
  result.residual = model::derivative(p, speed, result.state.data()).cwiseAbs().maxCoeff();
  return result;
}

// A trajectory with its past.
class Journey {
 public:
  Journey(const model::Parameters& p, double speed, const Eigen::VectorXd& state, double patience,
          const std::vector<KnownOrbit>& known, const StopFlag* stop)
      : p_(p), speed_(speed), difference_(p, speed), state_(state), patience_(patience), stop_(stop), known_(known) {}

  Settling settle();

 private:
  void nudge();
  bool travel_stretch(double duration);
  bool travel(double duration, MotionStatistics& statistics, std::vector<Eigen::VectorXd>* samples = nullptr);
  template <class Distance>
  bool approaches(double rate, const Distance& distance);
  std::optional<Motion> rest();
  std::optional<Motion> recurrence();
  std::optional<Motion> persistence();
  bool worth_trying(const Return& now);
  bool statistics_repeat(double share_of_extremes, double share_of_means) const;
  bool comes_back() const;
  bool creeps() const;

  const model::Parameters& p_;
  const double speed_;
  const StateDifference difference_;
  Eigen::VectorXd state_;
  const double patience_;
  const StopFlag* const stop_;
  double elapsed_ = 0.0;
  std::vector<Eigen::VectorXd> samples_;  // of the last part of the stretch
  MotionStatistics previous_, last_;      // of the last two stretches
  int repeats_ = 0;                       // stretches in a row that repeated the one before
  const std::vector<KnownOrbit>& known_;
  std::vector<KnownOrbit> orbits_;  // further stable ones met so far
  std::vector<Return> tried_;       // Newton's method did not find the motion from these
  IntegrationStatus status_ = IntegrationStatus::done;
  double ahead_ = 0.0;  // how far the last approach was followed beyond elapsed_
  bool recognised_ = false;
};

bool Journey::travel(double duration, MotionStatistics& statistics, std::vector<Eigen::VectorXd>* samples) {
  Eigen::VectorXd end = state_;
  status_ = follow(p_, speed_, end, duration, follow_tolerance, &statistics, samples, stop_);
  if (status_ != IntegrationStatus::done) return false;
  state_ = end;
  return true;
}

// Equal balls in one place stay there in exact arithmetic of equal operations, even where that is unstable. From the
// second stretch on they are kept this far apart, so that an unstable companionship breaks up.
void Journey::nudge() {
  constexpr double nudge = 1e-9;
  for (int i = 0; i < p_.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (std::fabs(wrapped(state_[model::index::phi(i)] - state_[model::index::phi(k)])) < nudge)
        state_[model::index::phi(i)] += nudge * (i + 1);
}

bool Journey::travel_stretch(double duration) {
  if (elapsed_ > 0.0) nudge();
  previous_ = last_;
  last_ = {};
  const double memory = std::min(duration, longest_memory);
  elapsed_ += duration;
  if (duration > memory && !travel(duration - memory, last_)) return false;
  if (!travel(memory, last_, &samples_)) return false;
  state_ = with_angles_reduced(p_, state_);  // only now: statistics count turns of unwrapped angles
  return true;
}

// Follows a copy of the trajectory that should come closer to a stable motion, whose slowest deviation shrinks at
// `rate` (negative), and says whether it does.
template <class Distance>
bool Journey::approaches(double rate, const Distance& distance) {
  ahead_ = 0.0;
  const double first = distance(state_);
  if (first > in_reach) return false;
  if (first < 1e-9) return true;
  const double chunk = std::max(1.0 / -rate, 1.0);
  Eigen::VectorXd z = state_;
  double left = patience_ - elapsed_, now = first;
  double& travelled = ahead_;
  // Away from the linear regime the distance may grow for a while; a motion left behind is not approached again soon.
  for (int k = 0; k < 40 && now < 2.0 * in_reach; ++k) {
    const double duration = std::min(chunk, left);
    if (duration <= 0.0) break;
    if (follow(p_, speed_, z, duration, follow_tolerance, nullptr, nullptr, stop_) != IntegrationStatus::done)
      return false;
    z = with_angles_reduced(p_, z);
    left -= duration;
    travelled += duration;
    now = distance(z);
    if (now < reached && now < 0.5 * first) return true;
    if (now < 1e-6) return true;
  }
  // Out of patience: what was seen must at least be half the decay that the linear theory promises.
  return now < 0.1 * in_reach && now < first * std::exp(0.5 * rate * travelled) && travelled * -rate > 0.5;
}

std::optional<Motion> Journey::rest() {
  // Faster than this no equilibrium is near: it swings at a rate of order one, so it would be as far away.
  if (difference_.length(model::derivative(p_, speed_, state_.data())) > in_reach) return std::nullopt;
  const int dimension = continuum_dimension(p_);
  if (dimension > 0) {
    const auto balanced = nearest_of_continuum(p_, speed_, state_);
    if (balanced && attracts(balanced->eigenvalues, dimension)) {
      double slowest = -1.0;
      for (const auto& value : balanced->eigenvalues)
        if (std::abs(value) >= zero_eigenvalue) slowest = std::max(slowest, value.real());
      std::optional<Equilibrium> end;
      const auto distance = [&](const Eigen::VectorXd& z) {
        end = nearest_of_continuum(p_, speed_, z);
        return end ? difference_.distance(z, end->state) : std::numeric_limits<double>::infinity();
      };
      if (approaches(slowest, distance) && end && attracts(end->eigenvalues, dimension))
        return describe_equilibrium(p_, speed_, *end);
    }
  }
  const auto equilibrium = refine_equilibrium(p_, speed_, state_);
  if (!equilibrium || !attracts(equilibrium->eigenvalues, 0)) return std::nullopt;
  const bool comes = approaches(equilibrium->eigenvalues[0].real(),
                                [&](const Eigen::VectorXd& z) { return difference_.distance(z, equilibrium->state); });
  if (!comes) return std::nullopt;
  return describe_equilibrium(p_, speed_, *equilibrium);
}

std::optional<Motion> Journey::recurrence() {
  const auto accepted = [&](const KnownOrbit& known) {
    const PeriodicOrbit& orbit = known.orbit;
    const double slowest =
        orbit.multipliers.size() > 1 ? std::log(std::max(1e-300, std::abs(orbit.multipliers[1]))) / orbit.period : -1.0;
    return approaches(slowest, [&](const Eigen::VectorXd& z) { return known.curve->distance(z); });
  };
  const auto described = [&](const KnownOrbit& known) {
    return known.motion ? *known.motion : describe_orbit(p_, speed_, known.orbit);
  };
  for (const KnownOrbit& known : known_) {
    if (!accepted(known)) continue;
    recognised_ = true;
    return described(known);
  }
  for (const KnownOrbit& known : orbits_)
    if (accepted(known)) return described(known);
  for (const Return& now : returns_to_last(samples_, sample_spacing(speed_), p_.balls, difference_, most_returns)) {
    if (!worth_trying(now)) continue;
    const auto guess = shoot(p_, speed_, state_, now.time, difference_, in_reach);
    if (!guess) continue;
    const auto orbit = refine_orbit(p_, speed_, guess->state, guess->period);
    if (!orbit || !orbit->stable()) continue;
    orbits_.push_back(known_orbit(p_, speed_, *orbit));
    if (accepted(orbits_.back())) return described(orbits_.back());
  }
  return std::nullopt;
}

// Newton's method that failed from a return is not asked again before the return has become twice as close: on the way
// to a periodic motion it does, on a torus it does not.
bool Journey::worth_trying(const Return& now) {
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

bool Journey::statistics_repeat(double share_of_extremes, double share_of_means) const {
  return previous_.duration > 0.0 && similar(previous_, last_, p_.balls, share_of_extremes, share_of_means);
}

// Whether all is so nearly at rest that the trajectory will not get anywhere in the time that is left: neither by its
// rate of change nor by what grows.
bool Journey::creeps() const {
  if (difference_.length(model::derivative(p_, speed_, state_.data())) * patience_ > in_reach) return false;
  return dense::largest_real_part(model::jacobian(p_, speed_, state_.data())) * patience_ < 1.0;
}

// Whether the trajectory, after it had been farthest from where it is now, came half as near again. What creeps has the
// same statistics in every stretch and no positive exponent, and was never where it is.
bool Journey::comes_back() const {
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

std::optional<Motion> Journey::persistence() {
  const bool tight = statistics_repeat(0.01, 0.005), loose = statistics_repeat(0.1, 0.05);
  repeats_ = tight ? repeats_ + 1 : 0;
  const bool final_stretch = elapsed_ >= patience_ * (1.0 - 1e-9);
  ahead_ = 0.0;
  if (!comes_back()) return std::nullopt;
  if (last_.duration < 1000.0 || !(repeats_ >= 2 || (final_stretch && loose))) return std::nullopt;
  const int count = std::min<int>(4, model::dimension(p_.balls));
  double duration = std::max(last_.duration, 4000.0);
  std::vector<double> exponents = lyapunov_exponents(p_, speed_, state_, duration, count, stop_);
  if (static_cast<int>(exponents.size()) < 2) return std::nullopt;
  // A slow way into a periodic motion looks like a torus for long: what is not clearly zero is measured again.
  if (exponents[0] < 8.0 / duration && exponents[1] < -clear_zero && exponents[1] > -8.0 / duration) {
    duration *= 8.0;
    exponents = lyapunov_exponents(p_, speed_, state_, duration, count, stop_);
    if (static_cast<int>(exponents.size()) < 2) return std::nullopt;
  }
  const double zero = 8.0 / duration;
  Motion motion;
  if (exponents[0] > zero) {
    if (!final_stretch) return std::nullopt;
    motion.kind = MotionKind::chaotic;
  } else if (exponents[0] > -zero && exponents[1] > -zero && repeats_ >= 2) {
    motion.kind = MotionKind::quasi_periodic;
  } else {
    return std::nullopt;
  }
  // A torus is measured afresh: the stretch that showed it may have begun before balls had quite joined.
  MotionStatistics fresh;
  const double last_duration = last_.duration;
  if (motion.kind == MotionKind::quasi_periodic && !travel(last_.duration, fresh)) return std::nullopt;
  motion.speed = speed_;
  // Slips of chaotic motion average out like the root of time: whether they do is worth a few stretches more.
  constexpr double longest = 16.0;
  while (motion.kind == MotionKind::chaotic && !drifts_are_known(p_, last_, motion) &&
         last_.duration < longest * last_duration)
    if (!travel(last_duration, last_)) return std::nullopt;
  motion.state = with_angles_reduced(p_, state_);
  motion.exponents = exponents;
  motion.stable = true;
  describe_statistics(p_, motion.kind == MotionKind::quasi_periodic ? fresh : last_, motion);
  motion.copies = count_copies(p_, motion);
  return motion;
}

Settling Journey::settle() {
  const double doublings = std::max(0.0, std::floor(std::log2(patience_ / first_stretch)));
  Settling result;
  for (double stretch = patience_ / std::exp2(doublings); elapsed_ < patience_ * (1.0 - 1e-9); stretch = elapsed_) {
    if (!travel_stretch(stretch)) break;
    result.motion = rest();
    if (!result.motion) result.motion = recurrence();
    if (!result.motion) result.motion = persistence();
    if (!result.motion && creeps()) break;
    if (!result.motion) continue;
    result.time = elapsed_ + ahead_;
    result.known = recognised_;
    return result;
  }
  result.status = status_;
  result.time = elapsed_;
  return result;
}

}  // namespace

KnownOrbit known_orbit(const model::Parameters& p, double speed, const PeriodicOrbit& orbit) {
  return {orbit, std::make_shared<const OrbitCurve>(p, speed, orbit), nullptr};
}

KnownOrbit known_orbit(const model::Parameters& p, double speed, const Motion& motion) {
  KnownOrbit result = known_orbit(p, speed, motion.orbit);
  result.motion = std::make_shared<const Motion>(motion);
  return result;
}

Settling settle(const model::Parameters& p, double speed, const Eigen::VectorXd& state, double patience,
                const std::vector<KnownOrbit>& known, const StopFlag* stop) {
  if (model::is_strobed(p)) {
    Settling result;
    result.motion = strobed_motion_from(p, speed, state, patience, stop);
    result.time = patience;
    return result;
  }
  return Journey(p, speed, state, patience, known, stop).settle();
}

std::optional<Motion> motion_from(const model::Parameters& p, double speed, const Eigen::VectorXd& state,
                                  double patience, const StopFlag* stop) {
  return settle(p, speed, state, patience, {}, stop).motion;
}

}  // namespace equipoise
