// One trajectory at stated times, at an even grid of them, or advanced on demand.
// This room: one trajectory at stated times; equations for other integrators.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/trajectory.hpp"
#include "equipoise/results/types/status.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Throws InputError unless these are finite, increasing and >= 0.
void check_output_times(const std::vector<double>& times);

/// Samples `study` by dense output at `times` (increasing, >= 0). The tolerance is study.numerics.tolerance, else
/// default_simulate_tolerance, per step, relative to each variable's size. Progress is in rows. One thread does
/// everything; no CPU target is chosen. Throws InputError for times out of order or an invalid study.
Trajectory simulate(const Study& study, const std::vector<double>& times, const RunOptions& options = {});

/// Beyond this, a double no longer resolves the rotor's angle.
inline constexpr double last_output_time = 1e9;
inline constexpr double most_output_rows = 1e8;

/// Times for simulate(): from 0 in steps of `every` up to `until`. Unset: until 100 after the last piece has begun and
/// the balls are free; a hundred intervals. Throws InputError for an invalid study, for invalid times, and for more
/// than most_output_rows of them.
std::vector<double> output_times(const Study& study, std::optional<double> until = {},
                                 std::optional<double> every = {});

/// One trajectory, advanced on demand, for players that draw it as it goes: the motion that simulate() samples. Each
/// advance() ends an integration step, so the number of calls changes the motion within the tolerance.
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
