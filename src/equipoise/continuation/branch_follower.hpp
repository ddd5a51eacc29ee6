// One motion from one parameter value to another: Newton's method for equilibria and periodic orbits, trajectories for
// tori and chaos.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "equipoise/base/error.hpp"
#include "equipoise/continuation/parameter_line.hpp"
#include "equipoise/results/branch.hpp"

namespace equipoise {

/// Tori and chaos, which cannot be refined.
bool is_restless(const Motion& motion);

/// A periodic motion of several turns: a torus may lock to it and go on beyond it, and chaos may have it for a window.
bool may_be_locked(const Motion& motion);

/// What a motion is called, whether it is a torus or chaotic or neither.
std::string family_of(const model::Parameters& p, const Motion& motion);

/// A restless motion at one parameter value may be the one at another: same family, like excursions; or, since names of
/// what is measured may differ by chance, excursions and rates of drift that are closely alike.
bool resembles(const model::Parameters& p, const Motion& a, const Motion& b);

/// How far an advance came.
struct Advance {
  double value = 0.0;
  Motion motion;
  bool arrived = false;
  double refused = 0.0;          ///< if not arrived: the nearest value at which the motion was not found
  std::optional<Motion> beyond;  ///< if not arrived: another motion met at that value
  bool carried = false;          ///< by trajectories, not by Newton's method
  /// If it was carried and has not arrived: all trajectories from its states that were tried at `refused` came to other
  /// stable motions, and random starts there found none like it.
  bool left = false;
};

class BranchContinuation {
 public:
  /// `starts`: random ones searched where trajectories leave a motion.
  BranchContinuation(const ParameterLine& line, std::uint64_t starts, const StopFlag* stop)
      : line_(line), starts_(starts), stop_(stop) {}

  /// From `motion` at `from` to the value `to`, one step of the line away at most. Newton's steps are halved where the
  /// method fails or the motion changes abruptly or in kind, down to 2^-16 of the line's step; a motion not found then
  /// ends. Restless motions, and periodic ones locked within them, are carried on by trajectories in steps as short as
  /// 1/64 of the line's, from several states in the end; what these miss, random starts may find.
  /// A stopped advance has not arrived.
  Advance advance(const Motion& motion, double from, double to) const;

  /// Where a motion ends that was seen at end.value, and at end.refused only as a motion of another branch: the same
  /// bracket made as narrow as that of an advance that did not arrive.
  Advance narrowed(const Advance& end) const;

  /// The equilibrium or periodic orbit at `to` that continues `motion`, in one step: what bisection needs.
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

}  // namespace equipoise
