// What a search found about its traps that the one at a neighbouring parameter may begin with: it finds the same traps
// or better ones sooner, and tries each as often.
#pragma once

#include <vector>

namespace equipoise {

/// The level of an attractor's traps, of balanced ones (traps/balanced_trap.hpp) by what they had before it was
/// widened; 0: none was found.
struct LevelHint {
  int attractor = 0;
  bool torus = false;  ///< of a trap around a torus, not around an orbit or a state
  double level = 0.0;
  bool operator==(const LevelHint&) const = default;
};

/// What an eigenvalue's mode weighs in the form of a balanced trap.
struct ModeWeight {
  double re = 0.0, im = 0.0, weight = 1.0;
  bool operator==(const ModeWeight&) const = default;
};

struct TrapHints {
  std::vector<LevelHint> levels;
  std::vector<ModeWeight> weights;

  const LevelHint* find(int attractor, bool torus) const {
    for (const LevelHint& hint : levels)
      if (hint.attractor == attractor && hint.torus == torus) return &hint;
    return nullptr;
  }
  /// 0: not known.
  double level(int attractor, bool torus) const {
    const LevelHint* hint = find(attractor, torus);
    return hint ? hint->level : 0.0;
  }
  bool operator==(const TrapHints&) const = default;
};

}  // namespace equipoise
