// How a trajectory comes to its motion: what motion_from() knows in addition to the motion.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/attractors/motions/motion_statistics.hpp"
#include "equipoise/attractors/periodic_orbits/recurrence.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

/// The first test whether a trajectory is steady comes after about this time, the longest that a quick attractor takes
/// to pull a start in.
inline constexpr double first_stretch = 100.0;

/// Trajectories are followed at a tolerance that keeps r true to 1e-8.
inline constexpr double follow_tolerance = 1e-9;
/// Returns are looked for in the last part of a stretch: longer than any period met (pair drift, under 300).
inline constexpr double longest_memory = 1200.0;
inline constexpr int most_returns = 6;
/// A trajectory this close to a stable motion, in natural sizes, and still approaching has reached it.
inline constexpr double reached = 1e-3;
/// Farther than this from a stable motion nothing is concluded yet.
inline constexpr double in_reach = 0.5;

struct Approach {
  std::optional<Motion> motion;  ///< empty if the trajectory did not become steady
  double time = 0.0;             ///< when it was recognised
};

/// A trajectory with its past. It is followed in stretches, each as long as all before it, until it is steady: as many
/// as patience has room for. On a stroboscopic section they are whole periods of the section.
class Journey {
 public:
  Journey(const model::System& system, const Eigen::VectorXd& state, double patience, const StopFlag* stop);
  virtual ~Journey() = default;
  Journey(const Journey&) = delete;
  Journey& operator=(const Journey&) = delete;

  Approach settle();

 protected:
  /// The motion that it is now seen to be on.
  virtual std::optional<Motion> seen() = 0;
  /// Whether it gets nowhere in the time left.
  virtual bool creeps() const { return false; }
  /// A last look after all stretches.
  virtual std::optional<Motion> seen_late() { return std::nullopt; }

  /// Whether the last two stretches look alike: extremes and means up to these shares.
  bool statistics_repeat(double share_of_extremes, double share_of_means) const {
    return previous_.duration > 0.0 && similar(previous_, last_, p_.balls, share_of_extremes, share_of_means);
  }
  bool on_section() const { return section_period_ > 0.0; }
  /// About that time, at least one period of the section.
  double whole(double time) const;
  bool is_over() const { return elapsed_ >= patience_ * (1.0 - 1e-9) || is_set(stop_); }
  /// Time between samples_.
  double spacing() const { return on_section() ? section_period_ : last_.spacing; }
  /// follow(), on a stroboscopic section in whole periods, so that each begins with rotor angle 0. `log`: of a system
  /// with events. False if the trajectory is lost.
  bool travel(Eigen::VectorXd& z, double duration, MotionStatistics* statistics = nullptr,
              std::vector<Eigen::VectorXd>* samples = nullptr, EventLog* log = nullptr) const;

  const model::System system_;
  const model::Parameters& p_;
  const StateDifference difference_;
  const StopFlag* const stop_;
  double section_period_;                // 0: there is no stroboscopic section
  double first_ = 0.0, patience_ = 0.0;  // of stretches: the first, and all together
  Eigen::VectorXd state_;
  Eigen::VectorXd end_;                   // of the last stretch: state_ with angles that count turns, for statistics
  double elapsed_ = 0.0, ahead_ = 0.0;    // how far the last approach was followed beyond elapsed_
  std::vector<Eigen::VectorXd> samples_;  // of the last part of the stretch
  EventLog log_;                          // of that part
  MotionStatistics previous_, last_;      // of the last two stretches
  int repeats_ = 0;                       // stretches in a row that repeated the one before

 private:
  // False if the trajectory is lost.
  bool travel_stretch(double duration);
};

/// Does what motion_from() does, and also says when. Once `stop` is set there is no motion.
Approach settle(const model::System& system, const Eigen::VectorXd& state, double patience, const StopFlag* stop);

/// Does settle() for a system with events. If nothing touches or sticks any more, the motion belongs to the system
/// without contact; it is refined there if no balls touch on it. Otherwise it is a rotor whose balls all stick
/// (attractors/equilibria/stuck.hpp); an equilibrium or periodic orbit on which balls touch or stick, or events recur
/// (attractors/periodic_orbits/return_map.hpp); or it is identified by statistics and the rate at which neighbours
/// part.
Approach settle_with_events(const model::System& system, const Eigen::VectorXd& state, double patience,
                            const StopFlag* stop);

/// Whether no balls touch on a motion of the system without contact.
bool stays_clear(const model::System& system, const Motion& motion);

/// The same system, but its balls pass each other and do not stick.
model::System without_events(const model::System& system);

}  // namespace equipoise
