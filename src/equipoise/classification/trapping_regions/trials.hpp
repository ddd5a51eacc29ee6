// Trials: states followed by the lanes that decide, to see what catches them. A trapping region is widened to a level
// from whose edge each of four thousand ends in the attractor.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/classification/balanced_regions/balanced_region.hpp"
#include "equipoise/classification/trapping_regions/orbit_region.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/core/running/stage_progress.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/batch/own_rotor.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"

namespace equipoise {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Shared by all trials.
struct TrialSettings {
  const model::System* system = nullptr;  ///< any smooth one
  double tolerance = 1e-6;
  int threads = 1;
  const StopFlag* stop = nullptr;
  StageProgress* progress = nullptr;
  NotePage* notes = nullptr;  ///< log of what was tried, or null
  /// Rotors that trials use in turn, again and again; none: all have that of `system`.
  std::span<const OwnRotor> rotors{};

  const OwnRotor* rotor(std::size_t number) const { return rotors.empty() ? nullptr : &rotors[number % rotors.size()]; }
};

/// Motions that attract more slowly get no trapping region by trials: to follow those would take longer than an
/// ensemble.
inline constexpr double slowest_worth_it = 2e-3;
/// All trials come to this share of the level that they begin on: a quarter of the level that will be used.
inline constexpr double come_inside = 0.125;
/// A trajectory whose V falls to this share has end in the motion. The first part of all trials is followed that far.
/// The others stop at come_inside: from there the first ones ended in the motion.
inline constexpr double come_close = 1e-3;

/// This many states are followed together and share a flight.
inline constexpr std::size_t trial_chunk = 128;
/// This many of all trials that a level must pass are run at a time.
inline constexpr std::size_t trial_part = 4 * trial_chunk;

struct Trials {
  struct Flight {
    double end = 0.0;  ///< duration
    double psi = 0.0;  ///< the rotor's angle at the beginning
  };
  std::vector<double> states;  ///< one after the other
  ClassificationRule rule;
  std::function<Flight(std::size_t first)> flight = {};  ///< of the chunk that begins with this state
  bool alike = false;                                    ///< all have the same flight, so chunks may be larger
  std::size_t first = 0;                                 ///< number of the first state's rotor

  void all_fly_for(double end) {
    alike = true;
    flight = [end](std::size_t) { return Flight{end, 0.0}; };
  }
};

inline constexpr double after_all_else = 1e9;  ///< a window's end: nothing waits for it
/// A rule without windows, in which only trapping regions decide.
ClassificationRule rule_of_regions(const model::System& system);

/// Whether all states are attracted; false if stopped.
bool all_attracted(Trials trials, const TrialSettings& settings);

/// Levels from `highest` down over this many halvings, in eighths of one. The steps are small, so a trial that rounding
/// sends elsewhere changes the level by little.
struct LevelLadder {
  double highest = 0.0;
  int halvings = 24;
};

/// A few trials find where to begin, all of them where to stop.
struct TrialCounts {
  std::size_t few = 128, all = 4096;
  bool low_may_fail = false;    ///< low levels may fail for rounding alone where higher ones pass
  bool first_goes_far = false;  ///< the first part is followed further, and a few of it run before the others
};

/// Trials first .. first + count - 1 of `of`.
struct TryRange {
  std::size_t first, count, of;
  /// The first part of all trials.
  bool goes_far() const { return first == 0 && count < of; }
};

/// Half the highest level at which good(level, tries) holds for all trials; 0 if there is none. Trials run in parts,
/// the first part last. That a pass at one level implies a pass at lower ones is assumed only to choose the next level.
/// `near`: a guess, or 0. The search then begins there, and goes up only if a few trials pass.
double highest_good_level(const LevelLadder& ladder, const TrialCounts& counts,
                          const std::function<bool(double level, const TryRange& tries)>& good, double near = 0.0);

/// One trial of a level.
struct Trial {
  std::size_t number, of;
  double level;
  const Eigen::VectorXd& direction;  ///< a unit vector
  const OwnRotor* own;               ///< the state's rotor, or null
};

/// highest_good_level() for states on level sets, all of which must be attracted. state(trial) makes them from
/// directions of `size` components. complete(trials, level, tries) sets their flights, and the regions in a rule of
/// rule_of_regions(); false: no trial can pass at this level.
template <class State, class Complete>
double level_by_trials(const TrialSettings& settings, Eigen::Index size, const LevelLadder& ladder,
                       const TrialCounts& counts, double near, const State& state, const Complete& complete) {
  Directions directions(size);
  const auto good = [&](double level, const TryRange& tries) {
    Trials trials;
    trials.first = tries.first;
    trials.rule = rule_of_regions(*settings.system);
    for (std::size_t i = tries.first; i < tries.first + tries.count; ++i) {
      const Eigen::VectorXd direction = directions[i],
                            z = state(Trial{i, tries.of, level, direction, settings.rotor(i)});
      trials.states.insert(trials.states.end(), z.begin(), z.end());
    }
    return complete(trials, level, tries) && all_attracted(std::move(trials), settings);
  };
  return highest_good_level(ladder, counts, good, near);
}

/// Sets the level of a motion's trapping regions (one, or several that are exchange images of each other). It is half
/// the highest of a falling series of levels from which all of 4096 states ended in the motion. `slowest_rate`: of the
/// approach, negative. False if no level passes, or if the search would take longer than an ensemble. `near`: as in
/// highest_good_level(). `floor`: the least to which V can fall, as rotors of trials have motions of their own
/// (own_floor()).
bool validate(std::vector<OrbitRegion>& regions, const TrialSettings& settings, double slowest_rate, double near = 0.0,
              double floor = 0.0);

/// Four times the largest V of the motion that some of the trials' rotors have in place of the surrounded one; is_it()
/// says which motion is the same. Infinite if a rotor has another motion there, or none.
double own_floor(const OrbitRegion& region, const TrialSettings& settings, const Motion& motion,
                 const std::function<bool(const model::Parameters&, const Motion&)>& is_it);

/// Widens `region`, within whose level V must decrease, as long as all of 4096 states on twice the level come to
/// balance. The factor is at most 64. Twice the level stays within half a turn of any ball and below `nearest_foreign`,
/// the smallest V on any pilot trajectory that ended elsewhere. `balanced`: the regions of all balanced states, with
/// levels inside which V decreases; a state balances whichever it enters. `near`: a guess of the factor, or 0.
void widen(BalancedRegion& region, const std::vector<BalancedRegion>& balanced, const TrialSettings& settings,
           double slowest_rate, double nearest_foreign, double near = 0.0);

/// Which of `states`, one after the other, enter a balanced region of `rule` within ten times what the linear flow
/// takes, without first entering a region of another motion; incomplete if stopped.
std::vector<char> come_to_balance(std::vector<double> states, const ClassificationRule& rule,
                                  const TrialSettings& settings, double slowest_rate);

}  // namespace equipoise
