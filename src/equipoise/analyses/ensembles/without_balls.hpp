// Follows an ensemble's rotor without balls, and with balls held where they start.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/base/stop_flag.hpp"
#include "equipoise/results/commands/transient_result.hpp"
#include "equipoise/results/types/outcome.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

struct OneBodyTask {
  const Study& study;  ///< with its horizon
  const Sampler& sampler;
  std::uint64_t starts = 0;               ///< of the ensemble, 1 or more
  std::span<const InitialState> given{};  ///< the caller's own starts; empty: drawn
  int threads = 1;
  const StopFlag* stop = nullptr;
};

/// Depends neither on threads nor on an earlier run. Empty if stopped.
std::optional<WithoutBalls> without_balls(const OneBodyTask& task);

/// How one start ended as one body.
struct OneBodyRun {
  Outcome outcome;
  TransientRow row;
};
/// For callers that show results as they come: the runs of starts first .. first + count - 1, and how they end.
/// without_balls() counts the runs without balls of `bare_runs_needed` starts, and with balls held of
/// most_held_starts, both from start 0 on and no more than the ensemble has.
std::vector<OneBodyRun> one_body_runs(const OneBodyTask& task, bool balls, std::uint64_t first, std::uint64_t count);
std::uint64_t bare_runs_needed(const OneBodyTask& task);
/// Without `held`, nothing is reported on those.
WithoutBalls counted_runs(const OneBodyTask& task, std::span<const OneBodyRun> bare, std::span<const OneBodyRun> held);

/// basin() of a study without balls: up to most_bare_runs starts draw what else is uncertain; if nothing is, one run is
/// enough. Throws InputError for what needs starts of balls: an output file, starts of your own, a half-width, a grid.
BasinResult bare_basin(const Study& study, const BasinOptions& options);
inline constexpr std::uint64_t most_bare_runs = 10000;

}  // namespace equipoise
