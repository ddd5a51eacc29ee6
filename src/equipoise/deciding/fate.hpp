// The fate of one start: outcome, attractor, grounds. Files store its codes and words: add to them, never change them.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "equipoise/deciding/decision_rule.hpp"

namespace equipoise {

/// Outcomes of a start.
enum class Outcome : signed char {
  attracted = 0,  ///< came to an attractor; Fate::attractor says which
  undecided = 1,  ///< came to none by the horizon
  diverged = 2,   ///< left every motion a balancer can make (divergence_limit)
  failed = 3,     ///< the integrator's step size vanished
  stalled = 4,    ///< a driven rotor whose motor did not bring it up to speed (Sommerfeld capture)
};

/// Codes of outcomes without an attractor, in files and arrays. Attractors have their identifiers, from 1.
inline constexpr short undecided_code = 0, diverged_code = -1, failed_code = -2, stalled_code = -3;

const char* name_of(Outcome outcome);  ///< the word in results and files: "undecided"

struct Fate {
  Outcome outcome = Outcome::undecided;
  DecidedBy by = DecidedBy::nothing;
  /// Identifier in the catalogue, from 1; 0: none, or a stationary motion that the rule does not list. Below 0: one of
  /// OwnRotor::met, until it is listed.
  short attractor = 0;
  double time = 0.0;    ///< study time at which it was known
  /// Driven rotors: mean psi', signed, of the final motion, or when last seen if undecided. NaN for all others, and if
  /// it was never measured.
  float mean_speed = std::numeric_limits<float>::quiet_NaN();
  /// Unbalance left by balls that dry friction holds (model/unbalance.hpp); NaN for all others, and for starts read
  /// from a file.
  float unbalance = std::numeric_limits<float>::quiet_NaN();
  /// The largest r over the last window of time that ended before the fate was known; NaN if none did.
  float radius = std::numeric_limits<float>::quiet_NaN();
  bool met = false;  ///< balls that collide: two of them touched before the fate was known
};

/// The attractor's identifier, or the code of another outcome.
short code_of(const Fate& fate);

/// A pilot's record of one trajectory: the features of its last long window, the range of that window's short ones, the
/// longest run of windows inside each box of the rule, and how near it came to balance.
struct PilotRecord {
  Features features{};
  FeatureBox range;
  bool finished_window = false;  ///< features and range are set
  std::array<int, most_boxes> longest_run{};
  double least_value = 1e300;  ///< smallest V of any balanced trap along the way; known in audits (DecisionRule::blind)
};

}  // namespace equipoise
