// Attractors continued along a parameter: branches of one motion each, and the events on them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/types/motion.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A motion at one of the parameter's values.
struct BranchPoint {
  std::size_t at = 0;  ///< index of the value
  double value = 0.0;
  Motion motion;
};

/// first_seen, last_seen: the motion was not continued further, and whether it ends there is not known.
enum class BranchChange { birth, death, first_seen, last_seen, stability_gained, stability_lost, kind };
/// "birth", "death", "first seen", "last seen", "stability gained", "stability lost", "kind".
const char* name_of(BranchChange change);

/// Why a branch changes. Multipliers are those of periodic motions, eigenvalues those of equilibria.
enum class BranchCause {
  fold,             ///< one multiplier is 1 (one eigenvalue 0) and the motion meets an unstable twin
  pitchfork,        ///< the same for a motion that exchanging balls maps onto itself
  period_doubling,  ///< one multiplier is -1
  neimark_sacker,   ///< a complex pair of multipliers has modulus 1
  hopf,             ///< a pair of eigenvalues is imaginary
  torus_to_chaos,   ///< with rising parameter, like the next ones
  chaos_to_torus,
  to_periodic,  ///< a torus or chaos gives way to a periodic motion
  from_periodic,
  attraction_ends,  ///< trajectories leave a torus or chaos for other motions, and random starts find none like it
  unresolved,       ///< unknown
};
/// "fold", "pitchfork", "period doubling" and so on; "not followed further" for unresolved.
const char* name_of(BranchCause cause);

/// Something that happens to a branch between two parameter values.
struct BranchEvent {
  int id = 0;
  BranchChange change = BranchChange::birth;
  BranchCause cause = BranchCause::unresolved;
  double low = 0.0, high = 0.0;                   ///< it happens between these
  double r_min = 0.0, r_mean = 0.0, r_max = 0.0;  ///< of the branch on the side where it exists, else on the lower side
  void set_excursion(const Motion& motion) { r_min = motion.r_min, r_mean = motion.r_mean, r_max = motion.r_max; }
  double middle() const { return 0.5 * (low + high); }
  /// Where the event is shown: the middle; for a branch not continued further, where it was seen.
  double place() const {
    return change == BranchChange::first_seen ? high : change == BranchChange::last_seen ? low : middle();
  }
};

/// One attractor, with its unstable parts.
struct Branch {
  int id = 0;
  std::string name, alias;
  std::vector<BranchPoint> points;  ///< by value
  std::vector<BranchEvent> events;  ///< by value
};

/// A stretch of parameter values.
struct ValueRange {
  double begin = 0.0, end = 0.0;
  bool stable = false;
};
/// The branch cut where it gains or loses stability, from its birth (or the first value at which it was seen) to its
/// death (or the last such value).
std::vector<ValueRange> ranges_of(const Branch& branch);

/// Growth rate of the slowest deviation: the largest real part of an eigenvalue, log|multiplier| / period, or Lyapunov
/// exponent. Shifts in time and along a continuum of balanced states are left out; for a torus both zeros.
double growth_rate(const Motion& motion);
/// Largest modulus of a Floquet multiplier, without shifts in time and along a continuum; NaN without multipliers.
double largest_multiplier(const Motion& motion);

struct BranchesResult : RunInfo {
  Study study;                 ///< as given; its own value of the parameter plays no part
  std::string key;             ///< of the parameter
  std::vector<double> values;  ///< rising
  double step = 0.0;
  std::uint64_t starts = 0;      ///< random starts searched at every value and half-way between
  std::vector<Branch> branches;  ///< by identifier
  bool partial = false;          ///< stopped before everything was continued
};

/// "final rotor speed Omega / critical speed" and so on; the key itself for parameters without a label.
std::string parameter_label(const std::string& key);

}  // namespace equipoise
