// The pilot's trajectories: their states at the final speed, made once, and what becomes of them under a rule.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "equipoise/base/stage_progress.hpp"
#include "equipoise/base/stop_flag.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/deciding/fate.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/spin_up/start_source.hpp"

namespace equipoise {

/// Long windows end at 1, 2, 4, 8 and 16 times the first: four comparisons, of which two in a row must agree.
inline constexpr double pilot_windows = 16.0;

class PilotRun {
 public:
  /// Scouts find motions; with their traps in place all of the pilot shows how far those and the boxes can be trusted.
  static constexpr std::size_t random_scouts = 1024, coincident_scouts = 32, random_starts = 4096;
  static constexpr std::size_t scouts = random_scouts + coincident_scouts;

  PilotRun(const model::System& system, const StartSource& source) : system_(system), source_(source) {}

  /// Random starts, starts with all balls together, and more random ones. False if stopped.
  bool make();
  /// Decides the first `count` of them by a rule, at `horizon` at the latest. False if stopped.
  bool follow(std::size_t count, const DecisionRule& rule, double horizon, int threads, const StopFlag* stop,
              StageProgress& stages);

  std::size_t size() const { return fates_.size(); }
  /// Of so many of them fates and records are known.
  std::size_t followed() const { return followed_; }
  const std::vector<Fate>& fates() const { return fates_; }
  const std::vector<PilotRecord>& records() const { return records_; }
  /// Tells what became of an undecided one.
  void name(std::size_t i, int attractor) { fates_[i].attractor = static_cast<short>(attractor); }
  /// Where start `i` was when it was decided; the second where it may be followed on from without the rotor's angle: at
  /// the next strobe, where that matters.
  Eigen::Map<const Eigen::VectorXd> state(std::size_t i) const;
  Eigen::VectorXd state_at_strobe(std::size_t i) const;

 private:
  const model::System& system_;
  const StartSource& source_;
  std::vector<double> begin_, states_;
  std::vector<Fate> fates_;
  std::vector<PilotRecord> records_;
  std::size_t followed_ = 0;
};

}  // namespace equipoise
