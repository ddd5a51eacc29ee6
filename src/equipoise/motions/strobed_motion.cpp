// Trajectories seen once a strobe: are they coming to a point that comes back, to a continuum of balanced states, or do
// they go on as before for ever. The plan is that of motion.cpp, whose words are explained there.
#include "equipoise/motions/strobed_motion.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/linearisation.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/motion_description.hpp"
#include "equipoise/motions/motion_statistics.hpp"
#include "equipoise/motions/motion_symmetry.hpp"
#include "equipoise/orbits/recurrence.hpp"
#include "equipoise/orbits/stroboscopic.hpp"

namespace equipoise {

namespace {

using Eigen::VectorXd;

constexpr double follow_tolerance = 1e-9, describe_tolerance = 1e-12;
// As in motion.cpp.
constexpr double first_stretch = 100.0, longest_memory = 1200.0, reached = 1e-3, in_reach = 0.5;
// Longest period looked for.
constexpr int most_revolutions = 24;
// A return farther off than this share of the trajectory's typical distance from its last state is none; except that
// after one strobe, which a trajectory on its way into a motion of that period need not show as any nearer.
constexpr double close_share = 0.3;
constexpr int most_returns = 6;
// Components of a state at rest that are smaller are zero to rounding.
constexpr double at_rest = 1e-9;

bool is_at_rest(const model::Parameters& p, const VectorXd& z) {
  if (z.head(4).lpNorm<Eigen::Infinity>() > at_rest) return false;
  return z.tail(p.balls).lpNorm<Eigen::Infinity>() <= at_rest;
}

class StrobedJourney {
 public:
  StrobedJourney(const model::Parameters& p, double speed, const VectorXd& state, double patience, const StopFlag* stop)
      : p_(p),
        speed_(speed),
        strobe_(model::strobe_period(p, speed)),
        difference_(p, speed),
        state_(state),
        patience_(std::max(1L, std::lround(patience / strobe_))),
        stop_(stop) {}

  std::optional<Motion> settle() {
    long stretch = std::max(1L, std::lround(first_stretch / strobe_));
    for (; elapsed_ < patience_; stretch = std::min(elapsed_, patience_ - elapsed_)) {
      if (!travel(stretch)) return std::nullopt;
      if (auto motion = continuum()) return motion;
      if (auto motion = recurrence()) return motion;
      if (auto motion = persistence()) return motion;
    }
    return std::nullopt;
  }

 private:
  bool advance(VectorXd& z, long strobes, MotionStatistics* statistics = nullptr) const {
    for (long k = 0; k < strobes; ++k)
      if (follow(p_, speed_, z, strobe_, follow_tolerance, statistics, nullptr, stop_) != IntegrationStatus::done)
        return false;
    return true;
  }

  // Equal balls in one place are kept this far apart, so that an unstable companionship breaks up.
  void nudge() {
    constexpr double apart = 1e-9;
    for (int i = 0; i < p_.balls; ++i)
      for (int k = 0; k < i; ++k)
        if (std::fabs(wrapped(state_[model::index::phi(i)] - state_[model::index::phi(k)])) < apart)
          state_[model::index::phi(i)] += apart * (i + 1);
  }

  bool travel(long strobes) {
    if (elapsed_ > 0) nudge();
    previous_ = last_;
    last_ = {};
    const long memory = std::min(strobes, std::lround(longest_memory / strobe_));
    elapsed_ += strobes;
    if (!advance(state_, strobes - memory, &last_)) return false;
    points_.assign(1, state_);
    for (long k = 0; k < memory; ++k) {
      if (!advance(state_, 1, &last_)) return false;
      points_.push_back(state_);
    }
    return true;
  }

  // Follows a copy of the trajectory that should come closer to a stable motion, whose slowest deviation shrinks by
  // `factor` a strobe, and says whether it does.
  template <class Distance>
  bool approaches(double factor, const Distance& distance) const {
    const double first = distance(state_), rate = -std::log(std::max(factor, 1e-300));
    if (first > in_reach || !(rate > 0.0)) return false;
    if (first < 1e-9) return true;
    const long chunk = static_cast<long>(std::min(1e6, std::ceil(1.0 / rate)));
    VectorXd z = state_;
    long left = patience_ - elapsed_, travelled = 0;
    double now = first;
    for (int k = 0; k < 40 && now < 2.0 * in_reach; ++k) {
      const long strobes = std::min(chunk, left);
      if (strobes <= 0) break;
      if (!advance(z, strobes)) return false;
      left -= strobes;
      travelled += strobes;
      now = distance(z);
      if ((now < reached && now < 0.5 * first) || now < 1e-6) return true;
    }
    // Out of patience: what was seen must at least be half the decay that the linear theory promises.
    const double promised = rate * static_cast<double>(travelled);
    return now < 0.1 * in_reach && now < first * std::exp(-0.5 * promised) && promised > 0.5;
  }

  // The member of a continuum of balanced states next to a state, as an orbit.
  std::optional<PeriodicOrbit> nearest_balanced(const VectorXd& z) const {
    double phi[model::max_balls];
    for (int i = 0; i < p_.balls; ++i) phi[i] = z[model::index::phi(i)];
    if (!model::project_to_balanced(p_, phi)) return std::nullopt;
    return refine_strobed(p_, speed_, {model::centred_state(p_, phi)});
  }

  std::optional<Motion> continuum() const {
    const int dimension = continuum_dimension(p_);
    if (dimension == 0) return std::nullopt;
    const auto here = nearest_balanced(state_);
    if (!here || !contracts(here->multipliers, dimension)) return std::nullopt;
    const double factor = std::abs(here->multipliers[dimension]);
    std::optional<PeriodicOrbit> end;
    const auto distance = [&](const VectorXd& z) {
      end = nearest_balanced(z);
      return end ? difference_.distance(z, end->nodes[0]) : std::numeric_limits<double>::infinity();
    };
    if (!approaches(factor, distance) || !end || !contracts(end->multipliers, dimension)) return std::nullopt;
    return describe_strobed(p_, speed_, *end);
  }

  std::optional<Motion> recurrence() {
    for (const PeriodicOrbit& orbit : orbits_)
      if (comes_to(orbit)) return describe_strobed(p_, speed_, orbit);
    for (const long strobes : returns()) {
      const std::vector<VectorXd> guess(points_.end() - 1 - strobes, points_.end() - 1);
      const auto orbit = refine_strobed(p_, speed_, guess, in_reach);
      if (!orbit || !contracts(orbit->multipliers)) continue;
      orbits_.push_back(*orbit);
      if (comes_to(*orbit)) return describe_strobed(p_, speed_, *orbit);
    }
    return std::nullopt;
  }

  bool comes_to(const PeriodicOrbit& orbit) const {
    const double factor = std::pow(std::abs(orbit.multipliers[0]), 1.0 / static_cast<double>(orbit.nodes.size()));
    return approaches(factor, [&](const VectorXd& z) {
      double least = std::numeric_limits<double>::infinity();
      for (const VectorXd& node : orbit.nodes) least = std::min(least, difference_.distance(z, node));
      return least;
    });
  }

  // Numbers of strobes after which the trajectory came back, the shortest first, each at least twice as close as those
  // before.
  std::vector<long> returns() const {
    const long most = std::min<long>(static_cast<long>(points_.size()) - 1,
                                     std::lround(most_revolutions * two_pi / model::strobe_angle(p_)));
    std::vector<double> squares{0.0};
    double sum = 0.0;
    for (std::size_t k = 1; k < points_.size(); ++k) {
      squares.push_back(difference_(points_[points_.size() - 1 - k], points_.back()).squaredNorm());
      sum += squares.back();
    }
    double record = close_share * close_share * sum / static_cast<double>(points_.size() - 1);
    std::vector<long> found;
    for (long k = 1; k <= most && static_cast<int>(found.size()) < most_returns; ++k) {
      const bool first = k == 1 && squares[1] < in_reach * in_reach;
      if (!first && squares[k] >= record) continue;
      found.push_back(k);
      record = std::min(record, 0.25 * squares[k]);
    }
    return found;
  }

  bool statistics_repeat(double share_of_extremes, double share_of_means) const {
    if (previous_.duration == 0.0) return false;
    return similar(previous_, last_, p_.balls, share_of_extremes, share_of_means);
  }

  std::optional<Motion> persistence() {
    const bool tight = statistics_repeat(0.01, 0.005), loose = statistics_repeat(0.1, 0.05);
    repeats_ = tight ? repeats_ + 1 : 0;
    const bool final_stretch = elapsed_ >= patience_;
    if (last_.duration < 1000.0 || !(repeats_ >= 2 || (final_stretch && loose))) return std::nullopt;
    const double duration = std::max(last_.duration, 4000.0), zero = 8.0 / duration;
    const std::vector<double> exponents = strobed_exponents(p_, speed_, state_, std::lround(duration / strobe_), stop_);
    if (exponents.size() < 2 || !(exponents[0] > -zero)) return std::nullopt;
    if (exponents[0] > zero ? !final_stretch : repeats_ < 2) return std::nullopt;
    Motion motion;
    motion.kind = exponents[0] > zero ? MotionKind::chaotic : MotionKind::quasi_periodic;
    // A torus is measured afresh: the stretch that showed it may have begun before balls had quite joined.
    MotionStatistics fresh;
    VectorXd z = state_;
    if (motion.kind == MotionKind::quasi_periodic) {
      if (!advance(z, std::lround(last_.duration / strobe_), &fresh)) return std::nullopt;
    }
    motion.strobed = true;
    motion.speed = speed_;
    motion.state = with_angles_reduced(p_, z);
    motion.exponents = exponents;
    motion.stable = true;
    describe_statistics(p_, motion.kind == MotionKind::quasi_periodic ? fresh : last_, motion);
    motion.copies = count_copies(p_, motion);
    const auto captured = [](int group) { return group == 0; };
    if (motion.kind == MotionKind::quasi_periodic && p_.gravity != 0.0 && p_.balls > 2 &&
        std::all_of(motion.drift_group.begin(), motion.drift_group.begin() + p_.balls, captured))
      motion.balanced = relaxes_to_balance(p_, speed_, z);
    if (motion.balanced) motion.copies = 1;
    return motion;
  }

  const model::Parameters& p_;
  const double speed_, strobe_;
  const StateDifference difference_;
  VectorXd state_;
  const long patience_;  // in strobes, as all times here
  const StopFlag* const stop_;
  long elapsed_ = 0;
  std::vector<VectorXd> points_;  // at the strobes of the last part of the stretch
  MotionStatistics previous_, last_;
  int repeats_ = 0;
  std::vector<PeriodicOrbit> orbits_;  // stable ones met so far
};

}  // namespace

std::optional<Motion> strobed_motion_from(const model::Parameters& p, double speed, const VectorXd& state,
                                          double patience, const StopFlag* stop) {
  return StrobedJourney(p, speed, state, patience, stop).settle();
}

Motion describe_creep(const model::Parameters& p, double speed, const VectorXd& state, double rate) {
  constexpr int strobes = 100;
  Motion motion;
  motion.kind = MotionKind::quasi_periodic;
  motion.strobed = motion.balanced = motion.stable = true;
  motion.speed = speed;
  motion.state = with_angles_reduced(p, state);
  motion.exponents = {0.0, rate};
  MotionStatistics statistics;
  VectorXd z = state;
  follow(p, speed, z, strobes * model::strobe_period(p, speed), follow_tolerance, &statistics);
  describe_statistics(p, statistics, motion);
  motion.drift.fill(0.0);
  motion.drift_group.fill(0);
  return motion;
}

Motion describe_strobed(const model::Parameters& p, double speed, const PeriodicOrbit& orbit) {
  Motion motion;
  motion.strobed = true;
  motion.strobes = static_cast<int>(orbit.nodes.size());
  motion.speed = speed;
  motion.state = with_angles_reduced(p, orbit.nodes.front());
  motion.spectrum = orbit.multipliers;
  motion.residual = orbit.residual;
  motion.orbit = orbit;
  for (const std::complex<double>& m : orbit.multipliers)
    motion.exponents.push_back(std::log(std::max(1e-300, std::abs(m))) / orbit.period);
  const bool rests = p.gravity == 0.0 && is_at_rest(p, orbit.nodes.front());
  motion.kind = rests ? MotionKind::equilibrium : MotionKind::periodic;
  MotionStatistics statistics;
  if (rests) {
    for (int i = 0; i < p.balls; ++i)
      for (int k = i + 1; k < p.balls; ++k)
        statistics.pair[i][k].begin(motion.state[model::index::phi(i)] - motion.state[model::index::phi(k)]);
    describe_pairs(p, statistics, motion);
  } else {
    motion.period = orbit.period;
    motion.winding = orbit.winding;
    const double strobe = model::strobe_period(p, speed);
    for (VectorXd z : orbit.nodes) follow(p, speed, z, strobe, describe_tolerance, &statistics);
    describe_statistics(p, statistics, motion);
  }
  motion.balanced = rests || leads_to_balance(p, speed, orbit);
  motion.stable = contracts(orbit.multipliers, rests ? continuum_dimension(p) : 0);
  motion.copies = count_copies(p, motion);
  return motion;
}

}  // namespace equipoise
