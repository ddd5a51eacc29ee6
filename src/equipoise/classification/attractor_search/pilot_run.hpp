// The pilot's trajectories: their states at the final speed, computed once, and their outcomes under a rule.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "equipoise/classification/rotor_family/drawn_source.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/core/running/stage_progress.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"

namespace equipoise {

/// Long windows end at 1, 2, 4, 8 and 16 times the first: four comparisons, of which two in a row must agree.
inline constexpr double pilot_windows = 16.0;

class PilotRun {
 public:
  /// Scouts find the motions. With trapping regions in place, the whole pilot then shows how far regions and boxes can
  /// be trusted. Where starts are dear, the pilot runs on for that purpose alone.
  struct Size {
    std::size_t random_scouts = 1024, coincident_scouts = 32, random_starts = 4096;

    /// One in this many random starts.
    Size part(std::size_t of) const { return {random_scouts / of, coincident_scouts, random_starts / of}; }
  };

  /// `initial`: initial values that starts do not draw. `drawn`: the source, if it draws rotors.
  PilotRun(const model::System& system, const SpinUp& source, const InitialState& initial, const Size& wanted,
           const DrawnSource* drawn = nullptr)
      : system_(system),
        source_(source),
        drawn_(drawn),
        initial_(initial),
        wanted_(wanted),
        task_(source.last_task()) {}

  /// Makes random scouts, scouts with all balls together, and more random starts. With a motor every other start is
  /// free from the beginning, at speeds from rest to the no-load speed: a slow rotor may stay slow, and one that has
  /// passed resonance may return to it. False if stopped.
  bool make();
  /// How many starts are scouts.
  std::size_t scouts() const { return scouts_; }
  /// How many scouts (the first ones) are random: balls all in one place may stay on a motion that nothing else comes
  /// to.
  std::size_t random_ones() const { return random_ones_; }
  /// Decides the first `count` by a rule, up to `horizon`. False if stopped.
  bool follow(std::size_t count, const ClassificationRule& rule, double horizon, int threads, const StopFlag* stop,
              StageProgress& stages, NotePage& notes);

  std::size_t size() const { return outcomes_.size(); }
  /// How many outcomes and records are known.
  std::size_t followed() const { return followed_; }
  const std::vector<Outcome>& outcomes() const { return outcomes_; }
  const std::vector<PilotRecord>& records() const { return records_; }
  /// Names the motion of an undecided start.
  void name(std::size_t i, int attractor) { outcomes_[i].attractor = static_cast<short>(attractor); }
  /// Where start `i` was decided, and from where it can be followed on without the rotor's angle: on the next
  /// stroboscopic section, if there is one.
  Eigen::Map<const Eigen::VectorXd> state(std::size_t i) const;
  Eigen::VectorXd state_on_section(std::size_t i) const;
  /// The system of start `i`, and its rotor if starts draw theirs, else null.
  const model::System& system(std::size_t i) const { return rotors_.empty() ? system_ : rotors_[i].system; }
  const OwnRotor* rotor(std::size_t i) const { return rotors_.empty() ? nullptr : &rotors_[i]; }
  /// Rotors to be prepared for the rule; none if all share the system's.
  std::span<OwnRotor> rotors() { return rotors_; }

 private:
  bool add(std::size_t first, std::size_t count);
  void append(const SpunUp& starts);
  bool decide(std::size_t count, const ClassificationRule& rule, double horizon, int threads, const StopFlag* stop,
              StageProgress& stages);
  SpunUp free_at_speeds(std::size_t first, std::size_t count) const;

  const model::System& system_;
  const SpinUp& source_;
  const DrawnSource* drawn_;
  InitialState initial_;
  const Size wanted_;
  const BatchTask task_;
  std::vector<double> begin_, states_;
  std::vector<OwnRotor> rotors_;  // each start's own, or none
  std::vector<Outcome> outcomes_;
  std::vector<PilotRecord> records_;
  std::size_t scouts_ = 0, random_ones_ = 0, followed_ = 0;
};

}  // namespace equipoise
