// One trajectory, advanced on demand, for players that draw it as it goes.
#pragma once

#include <memory>

#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/results/types/status.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The motion that simulate() samples. Each advance() ends an integration step, so the number of calls changes the
/// motion within the tolerance.
class FollowedRun {
 public:
  /// From [initial] or from `start`. Throws InputError for invalid studies and for balls that overlap.
  explicit FollowedRun(const Study& study);
  FollowedRun(const Study& study, const InitialState& start);
  ~FollowedRun();
  FollowedRun(const FollowedRun&) = delete;
  FollowedRun& operator=(const FollowedRun&) = delete;

  double time() const;
  /// Does nothing if `until` is past.
  IntegrationStatus advance(double until);
  /// Appends the present state.
  void record(Trajectory& out) const;
  /// Whether the balls are clamped.
  bool clamped() const;
  const Study& study() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace equipoise
