// Tries: states followed by the lanes that decide, to see what catches them.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "equipoise/base/random.hpp"
#include "equipoise/base/stop_flag.hpp"
#include "equipoise/batch/own_rotor.hpp"
#include "equipoise/classification/classification_rule.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/running/search_log.hpp"
#include "equipoise/running/stage_progress.hpp"

namespace equipoise {

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// What all tries share.
struct TrialSettings {
  const model::System* system = nullptr;  ///< any smooth one
  double tolerance = 1e-6;
  int threads = 1;
  const StopFlag* stop = nullptr;
  StageProgress* progress = nullptr;
  NotePage* notes = nullptr;  ///< of what was tried, or null
  /// Rotors that tries have, one after the other and round again; none: all have that of `system`.
  std::span<const OwnRotor> rotors{};

  const OwnRotor* rotor(std::size_t number) const { return rotors.empty() ? nullptr : &rotors[number % rotors.size()]; }
};

/// Motions that are approached more slowly have no trapping region made by tries: to follow these would take longer
/// than an ensemble.
inline constexpr double slowest_worth_it = 2e-3;
/// All tries come to this share of the level that they begin on: a quarter of the level that will be used.
inline constexpr double come_inside = 0.125;

/// As many states are followed together, and share how they are.
inline constexpr std::size_t trial_chunk = 128;
/// So many are asked at a time of all that a level must pass.
inline constexpr std::size_t trial_part = 4 * trial_chunk;

struct Trials {
  struct Flight {
    double end = 0.0;  ///< how long
    double psi = 0.0;  ///< the rotor's angle when it begins
  };
  std::vector<double> states;  ///< one after the other
  ClassificationRule rule;
  std::function<Flight(std::size_t first)> flight;  ///< of the chunk that begins with this state
  bool alike = false;                               ///< all fly alike: chunks may be larger
  std::size_t first = 0;                            ///< number of the first state's rotor
};

/// A rule without windows: trapping regions alone decide.
ClassificationRule rule_of_regions(const model::System& system);

/// What `rule` knows of trapping regions, and nothing of windows.
ClassificationRule regions_of(const ClassificationRule& rule);

/// All of them are attracted; false if stopped.
bool all_attracted(Trials trials, const TrialSettings& settings);
/// Which of them come to this attractor; if stopped, not all that would.
std::vector<char> come_to(int attractor, Trials trials, const TrialSettings& settings);

/// Unit vectors, the same for every study.
class Directions {
 public:
  explicit Directions(Eigen::Index size) : v_(size) {}
  const Eigen::VectorXd& next();

 private:
  RandomStream random_;
  Eigen::VectorXd v_;
};

/// The same by number, for who asks again and again.
class DirectionTable {
 public:
  explicit DirectionTable(Eigen::Index size) : directions_(size) {}
  const Eigen::VectorXd& operator[](std::size_t number);

 private:
  Directions directions_;
  std::deque<Eigen::VectorXd> made_;
};

/// Levels from `highest` down over so many halvings, in eighths of one: where a rounding sends a try elsewhere the
/// level that is found changes by little.
struct LevelLadder {
  double highest = 0.0;
  int halvings = 24;
};

/// A few tries find where to begin, all of them where to stop.
struct TrialCounts {
  std::size_t few = 128, all = 4096;
  bool first_goes_far = false;  ///< the first part is followed farther: a few of it are asked before the others
};

/// Tries first .. first + count - 1 of `of`.
struct TryRange {
  std::size_t first, count, of;
};

/// Half the highest level for which good(level, tries) holds of all tries, which are asked in parts, the first part
/// last; 0 if there is none. What passes on a level is taken to pass on lower ones only to choose which level is tried
/// next. `near`: what it may be, 0 if that is not known; the search then begins there, and goes up only where a few
/// tries say so.
double highest_good_level(const LevelLadder& ladder, const TrialCounts& counts,
                          const std::function<bool(double level, const TryRange& tries)>& good, double near = 0.0);

}  // namespace equipoise
