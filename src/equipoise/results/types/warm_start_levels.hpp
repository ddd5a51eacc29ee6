// What a search found about its trapping regions that the one at a neighbouring parameter may begin with: it finds the
// same trapping regions or better ones sooner, and tries each as often.
#pragma once

#include <vector>

namespace equipoise {

/// How much a search for attractors does.
enum class SearchMode {
  full,
  /// All motions at a neighbouring parameter are known: a pilot of a quarter of the starts then looks for new ones. One
  /// that it misses is listed once a start ends in it, as always.
  warm,
  /// For an ensemble of one chunk (256 starts), which costs less than a search. The pilot has few_scouts starts, only
  /// balance gets trapping regions, and windows decide the rest. Of starts that end in another motion one is followed
  /// for all that look like it, and no more than most_followed_of_few in all: others stay undecided. With events none
  /// is followed: its windows show its motion (MotionKind::measured).
  few
};
/// A search serves this many starts if nothing else is said.
inline constexpr double many_starts = 1e5;
/// A first look at a machine, one of many, serves no more.
inline constexpr double starts_of_a_first_look = 1e3;

/// The level of an attractor's trapping regions, of balanced ones (classification/balanced_regions/balanced_region.hpp)
/// by what they had before it was widened; 0: none was found.
struct WarmStartLevel {
  int attractor = 0;
  double level = 0.0;
  bool operator==(const WarmStartLevel&) const = default;
};

/// What an eigenvalue's mode weighs in the form of a balanced trapping region.
struct ModeWeight {
  double re = 0.0, im = 0.0, weight = 1.0;
  bool operator==(const ModeWeight&) const = default;
};

struct WarmStartLevels {
  std::vector<WarmStartLevel> levels;
  std::vector<ModeWeight> weights;

  /// 0: not known.
  double level(int attractor) const {
    for (const WarmStartLevel& one : levels)
      if (one.attractor == attractor) return one.level;
    return 0.0;
  }
  bool operator==(const WarmStartLevels&) const = default;
};

}  // namespace equipoise
