// Continues one motion from one parameter value to another: by Newton's method for equilibria and periodic orbits, by
// trajectories for tori and chaos. Events on a branch, and names of branches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/analyses/continuation/parameter_line.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/branch.hpp"

namespace equipoise {

/// Motions that cannot be refined: tori, chaos, and motions with events.
bool is_restless(const Motion& motion);

/// A periodic motion of several turns: a torus may lock to it and continue beyond, and chaos may have it as a window.
bool may_be_locked(const Motion& motion);

/// The motion's name without its kind (torus, chaotic or neither).
std::string family_of(const model::Parameters& p, const Motion& motion);

/// Whether a restless motion at one parameter value may be the one at another: same family and similar excursions.
/// Measured names may differ by chance; closely similar excursions and drift rates then suffice.
bool resembles(const model::Parameters& p, const Motion& a, const Motion& b);

struct ValueSearch {
  std::vector<Motion> motions;    ///< stable motions, and balance
  std::vector<Motion> commonest;  ///< of every name the one that most starts come to
};

/// What `attractors` finds with this many random starts, on one thread; `warm_start_states` are followed as well.
ValueSearch attractors_at(const Study& study, std::uint64_t starts,
                          const std::vector<std::vector<double>>& warm_start_states, const StopFlag* stop);

/// How far an advance came.
struct Advance {
  double value = 0.0;
  Motion motion;
  bool arrived = false;
  double refused = 0.0;          ///< if not arrived: the nearest value at which the motion was not found
  std::optional<Motion> beyond;  ///< if not arrived: another motion met at that value
  bool carried = false;          ///< by trajectories, not by Newton's method
  /// If carried but not arrived: all trajectories tried at `refused` came to other stable motions, and random starts
  /// found none like it there.
  bool left = false;
};

class BranchContinuation {
 public:
  /// `starts`: random starts tried where trajectories leave a motion.
  BranchContinuation(const ParameterLine& line, std::uint64_t starts, const StopFlag* stop)
      : line_(line), starts_(starts), stop_(stop) {}

  /// Continues `motion` from value `from` to `to`, at most one step of the line. Newton's steps are halved where the
  /// method fails or the motion changes abruptly or in kind, down to 2^-16 of the line's step; a motion not found then
  /// ends. Restless motions, and periodic ones locked within them, are carried by trajectories in steps down to 1/64 of
  /// the line's, finally from several states. Random starts may find what these miss. If stopped: not arrived.
  Advance advance(const Motion& motion, double from, double to) const;

  /// For a motion seen at end.value but found only on another branch at end.refused: narrows the bracket as far as for
  /// an advance that did not arrive.
  Advance narrowed(const Advance& end) const;

  /// The equilibrium or periodic orbit at `to` that continues `motion`, in one step, for bisection.
  std::optional<Motion> refine(const Motion& motion, double to) const;

  bool stopped() const { return stop_ && stop_->load(std::memory_order_relaxed); }
  const ParameterLine& line() const { return line_; }

 private:
  Advance advance_refined(const Motion& motion, double from, double to) const;
  Advance advance_restless(const Motion& motion, double from, double to) const;

  // What trajectories from a motion come to at another value.
  struct Meeting {
    std::optional<Motion> same, other;
    bool left = true;  // all came to other stable motions
  };
  Meeting meet(const Advance& at, double value, int states) const;
  std::vector<Eigen::VectorXd> states_along(const Advance& at, int count) const;
  std::optional<Motion> find_by_starts(const Advance& at, double value) const;

  const ParameterLine& line_;
  const std::uint64_t starts_;
  const StopFlag* stop_;
};

/// Why a branch ends where `end` stopped; unresolved if nothing shows it.
BranchCause cause_of_end(const BranchContinuation& follower, const Advance& end);

/// Changes of stability and kind between two neighbouring points of a branch, in order of value. Bisection brackets
/// them to 1/256 of the line's step for equilibria and periodic motions, to 1/16 for tori and chaos.
std::vector<BranchEvent> changes_between(const BranchContinuation& follower, const BranchPoint& low,
                                         const BranchPoint& high);

/// Gives every branch the name of its motion at most of its points, stable ones first, and the identifier for that
/// name. Among branches of one name, the one with the most `votes` (then the one that attracts at most values) gets the
/// identifier; the others are numbered and get free identifiers. Events get their branch's identifier; branches are
/// ordered by it. `systems`: by index of the value.
void name_branches(const std::vector<model::System>& systems, const std::vector<std::size_t>& votes,
                   std::vector<Branch>& branches);

}  // namespace equipoise
