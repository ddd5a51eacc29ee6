// What a search found about its trapping regions that the one at a neighbouring parameter may begin with: it finds the
// same trapping regions or better ones sooner, and tries each as often.
#pragma once

#include <vector>

namespace equipoise {

/// The level of an attractor's trapping regions, of balanced ones (classification/balanced_regions/balanced_region.hpp)
/// by what they had before it was widened; 0: none was found.
struct WarmStartLevel {
  int attractor = 0;
  bool torus = false;  ///< of a trapping region around a torus, not around an orbit or a state
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

  const WarmStartLevel* find(int attractor, bool torus) const {
    for (const WarmStartLevel& one : levels)
      if (one.attractor == attractor && one.torus == torus) return &one;
    return nullptr;
  }
  /// 0: not known.
  double level(int attractor, bool torus) const {
    const WarmStartLevel* found = find(attractor, torus);
    return found ? found->level : 0.0;
  }
  bool operator==(const WarmStartLevels&) const = default;
};

}  // namespace equipoise
