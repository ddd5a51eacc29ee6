// Follows a trajectory stretch by stretch.
#include "equipoise/attractors/motions/approach.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/machine/balance/coincident_balls.hpp"

namespace equipoise {

Journey::Journey(const model::System& system, const Eigen::VectorXd& state, double patience, const StopFlag* stop)
    : system_(system),
      p_(system_.parameters()),
      difference_(system_),
      stop_(stop),
      section_period_(system.section() == model::Section::stroboscopic ? system.section_period() : 0.0),
      state_(state) {
  const double doublings = std::max(0.0, std::floor(std::log2(patience / first_stretch)));
  first_ = whole(patience / std::exp2(doublings));
  patience_ = first_ * std::exp2(doublings);
}

double Journey::whole(double time) const {
  return on_section() ? section_period_ * std::max(1.0, std::round(time / section_period_)) : time;
}

Approach Journey::settle() {
  Approach result;
  for (double stretch = first_; !is_over(); stretch = elapsed_) {
    if (!travel_stretch(stretch) || system_.runs_away(system_.speed(state_))) break;
    ahead_ = 0.0;
    result.motion = seen();
    if (!result.motion && creeps()) break;
    if (!result.motion) continue;
    result.time = elapsed_ + ahead_;
    return result;
  }
  result.motion = seen_late();
  result.time = elapsed_ + ahead_;
  return result;
}

bool Journey::travel_stretch(double duration) {
  // A given trajectory may have coincident balls (as some starts of an attractor search do). Whether they stay together
  // shows from the second stretch on.
  if (system_.smooth() && elapsed_ > 0.0)
    model::part_coincident(p_, &state_[model::index::phi(0)], &state_[model::index::q(0, p_.balls)]);
  previous_ = last_;
  last_ = MotionStatistics();
  const double memory = std::min(system_.smooth() ? duration : 0.5 * duration, whole(longest_memory));
  elapsed_ += duration;
  end_ = state_;
  if (duration > memory && !travel(end_, duration - memory, &last_)) return false;
  if (!travel(end_, memory, &last_, &samples_, &log_)) return false;
  state_ = system_.with_angles_reduced(end_);
  return true;
}

bool Journey::travel(Eigen::VectorXd& z, double duration, MotionStatistics* statistics,
                     std::vector<Eigen::VectorXd>* samples, EventLog* log) const {
  EventLog all;
  const auto go = [&](double time, EventLog& events, std::vector<Eigen::VectorXd>* on_the_way) {
    const auto status = system_.smooth()
                            ? follow(system_, z, time, follow_tolerance, statistics, on_the_way, stop_)
                            : follow_events(system_, z, time, follow_tolerance, events, statistics, on_the_way, stop_);
    return status == IntegrationStatus::done;
  };
  if (!on_section()) {
    if (!go(duration, all, samples)) return false;
  } else {
    if (samples) samples->assign(1, z);
    const long periods = std::lround(duration / section_period_);
    for (long k = 0; k < periods; ++k) {
      EventLog one;
      if (!go(section_period_, one, nullptr)) return false;
      if (k == 0) all.begin = one.begin;
      for (BallEvent e : one.events) {
        e.time += static_cast<double>(k) * section_period_;
        all.events.push_back(e);
      }
      all.count += one.count;
      all.end = one.end;
      if (samples) samples->push_back(z);
    }
  }
  if (log) *log = std::move(all);
  return true;
}

}  // namespace equipoise
