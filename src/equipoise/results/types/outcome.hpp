// What became of one start, on what grounds, and how that is reported in numbers and words: one line for each outcome,
// from which every report of it is made.
// This room: plain types that engine and results share: outcomes, motions, attractors, transients, warm starts.
#pragma once

#include <array>
#include <limits>
#include <optional>

namespace equipoise {

/// Outcomes of a start.
enum class OutcomeKind : signed char {
  attracted = 0,  ///< ended in an attractor; Outcome::attractor says which
  undecided = 1,  ///< reached none by the horizon
  diverged = 2,   ///< left every motion a balancer can make (divergence_limit)
  failed = 3,     ///< the integrator's step size vanished
  stalled = 4,    ///< a driven rotor whose motor did not bring it up to speed (Sommerfeld capture)
};

/// On what grounds an outcome was decided. The numbers are stored in result files.
enum class DecidedBy : signed char {
  nothing = 0,
  proof = 1,      ///< inside a level set proved to lead to the attractor only
  validated = 2,  ///< inside a level set from the edge of one of twice the level every one of a thousand tried states
                  ///< or more ended in the attractor
  windows = 3,    ///< features of successive windows of time
  horizon = 4,    ///< there at the horizon
  followed = 5,   ///< stationary by its windows in a way that the rule did not know; then followed to its motion
};
inline constexpr int decided_by_count = 6;
inline constexpr std::array<const char*, decided_by_count> decided_by_names{"nothing", "proof",   "validated",
                                                                            "windows", "horizon", "followed"};

/// The identifier of the balanced state in every catalogue.
inline constexpr int balanced_id = 1;

/// What stands for those that no attractor's identifier stands for, in files and arrays.
inline constexpr short undecided_code = 0, diverged_code = -1, failed_code = -2, stalled_code = -3;

/// An outcome of starts that end in no attractor.
struct NoAttractor {
  OutcomeKind kind;
  short code;        ///< in files and arrays, where an attractor has its identifier
  const char* name;  ///< its one word
};
inline constexpr std::array<NoAttractor, 4> no_attractors{{
    {OutcomeKind::undecided, undecided_code, "undecided"},
    {OutcomeKind::diverged, diverged_code, "diverged"},
    {OutcomeKind::failed, failed_code, "failed"},
    {OutcomeKind::stalled, stalled_code, "stalled"},
}};
constexpr const NoAttractor& told_of(OutcomeKind kind) {
  for (const NoAttractor& n : no_attractors)
    if (n.kind == kind) return n;
  return no_attractors[2];
}
/// The word in results and files.
constexpr const char* name_of(OutcomeKind kind) {
  return kind == OutcomeKind::attracted ? "attracted" : told_of(kind).name;
}

struct Outcome {
  OutcomeKind kind = OutcomeKind::undecided;
  DecidedBy by = DecidedBy::nothing;
  /// Identifier in the catalogue, from 1; 0: none, or a stationary motion that the rule does not list. Below 0: one of
  /// OwnRotor::met, until it is listed.
  short attractor = 0;
  double time = 0.0;  ///< study time at which it was known
  /// Of a driven rotor: mean psi' of the motion it came to, or, of an undecided start, when it was last seen; signed.
  /// NaN where it was never measured, and for all others.
  float mean_speed = std::numeric_limits<float>::quiet_NaN();
  /// Unbalance left by balls that dry friction holds (machine/model/unbalance.hpp); NaN for all others, and for starts
  /// read from a file.
  float unbalance = std::numeric_limits<float>::quiet_NaN();
  /// The largest r of the motion that it came to, measured on its own trajectory
  /// (classification/start_runs/later_figures.cpp); NaN if it was not measured.
  float radius = std::numeric_limits<float>::quiet_NaN();
  bool met = false;  ///< balls that collide: two of them touched before the outcome was known
};

/// The attractor's identifier, or the code of another outcome.
inline short code_of(const Outcome& outcome) {
  return outcome.kind == OutcomeKind::attracted ? outcome.attractor : told_of(outcome.kind).code;
}
/// A Outcome with this code; empty if no outcome has it.
inline std::optional<Outcome> outcome_of(short code) {
  Outcome outcome;
  if (code > 0) {
    outcome.kind = OutcomeKind::attracted;
    outcome.attractor = code;
    return outcome;
  }
  for (const NoAttractor& n : no_attractors) {
    outcome.kind = n.kind;
    if (n.code == code) return outcome;
  }
  return std::nullopt;
}

}  // namespace equipoise
