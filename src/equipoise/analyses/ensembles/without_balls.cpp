// One run of one body for each start, or for all; counted as the ensemble's transients are.
#include "equipoise/analyses/ensembles/without_balls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/rotor_family/study_family.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/held_run.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

class OneBodyRunner {
 public:
  explicit OneBodyRunner(const OneBodyTask& task)
      : task_(task), study_(task.study), settings_(transient_settings(study_)) {
    if (!study_.uncertain.empty()) family_.emplace(study_);
  }

  std::vector<OneBodyRun> runs(bool balls, std::uint64_t first, std::uint64_t count) const {
    std::vector<OneBodyRun> runs(count);
    in_parallel(task_.threads, count, [&](std::size_t i) {
      if (!is_set(task_.stop)) runs[i] = one(balls, first + i);
    });
    return runs;
  }

 private:
  // Values that make no study are lost, as in the ensemble.
  OneBodyRun one(bool balls, std::uint64_t i) const {
    const std::uint64_t seed = study_.sampling.seed;
    if (!task_.given.empty()) return follow(study_, task_.given[i], balls);
    if (!family_) return follow(study_, start_of(study_, task_.sampler, seed, i), balls);
    try {
      const Study own = family_->at(family_->values_at(drawn_fractions(study_, task_.sampler, seed, i)));
      OneBodyRun run = follow(own, start_of(own, task_.sampler, seed, i), balls);
      if (own.scales) change_units(*own.scales, *study_.scales, run.outcome, &run.row);
      return run;
    } catch (const InputError&) {
      return lost();
    }
  }

  static OneBodyRun lost() {
    OneBodyRun run{{}, transient_row({}, {}, true)};
    run.outcome.kind = OutcomeKind::failed;
    return run;
  }

  OneBodyRun follow(Study study, InitialState start, bool balls) const {
    if (!balls) take_balls_off(study, start);
    TransientSettings settings = transient_settings(study, settings_);
    const HeldRun run = follow_held(study, start, settings, task_.stop);
    if (run.lost) return lost();
    const bool driven = study.speed.driven(), free = std::isfinite(run.released);
    settings.work = WorkSource::none;
    settings.release = free ? run.released : 0.0;
    OneBodyRun result{{}, transient_row(settings, run.sums, false, run.end)};
    if (!free) result.row.settling_time = std::numeric_limits<float>::infinity();
    result.outcome.kind = !run.steady                                            ? OutcomeKind::undecided
                          : driven && std::fabs(run.speed) < study.stall_speed() ? OutcomeKind::stalled
                                                                                 : OutcomeKind::attracted;
    if (driven) result.outcome.mean_speed = static_cast<float>(run.speed);
    return result;
  }

  const OneBodyTask& task_;
  const Study& study_;
  const TransientSettings settings_;
  std::optional<StudyFamily> family_;
};

// Whether starts begin with rotors, or motions of the rotor, of their own.
bool rotors_differ(const OneBodyTask& task) {
  const SamplingBox& box = task.study.sampling.box;
  const auto otherwise = [&](const InitialState& s) {
    const InitialState& first = task.given.front();
    return s.psi != first.psi || s.x != first.x || s.y != first.y || s.x_dot != first.x_dot || s.y_dot != first.y_dot;
  };
  return !task.study.uncertain.empty() || box.x || box.y || box.x_dot || box.y_dot ||
         std::any_of(task.given.begin(), task.given.end(), otherwise);
}

OneBodyRuns counted(const OneBodyTask& task, std::span<const OneBodyRun> runs) {
  TransientTally tally(task.study, task.sampler);
  OneBodyRuns result;
  for (const OneBodyRun& r : runs) {
    tally.add(r.outcome, r.row);
    result.stalled += r.outcome.kind == OutcomeKind::stalled;
    result.open += r.outcome.kind == OutcomeKind::undecided;
  }
  const TransientResult all = tally.result(Catalogue());
  result.figures = all.groups.front();
  result.first = all.first;
  result.lost = all.lost;
  result.runs = runs.size();
  return result;
}

}  // namespace

std::vector<OneBodyRun> one_body_runs(const OneBodyTask& task, bool balls, std::uint64_t first, std::uint64_t count) {
  return OneBodyRunner(task).runs(balls, first, count);
}

std::uint64_t bare_runs_needed(const OneBodyTask& task) { return rotors_differ(task) ? most_held_starts : 1; }

WithoutBalls counted_runs(const OneBodyTask& task, std::span<const OneBodyRun> bare, std::span<const OneBodyRun> held) {
  WithoutBalls result{counted(task, bare), held.empty() ? OneBodyRuns() : counted(task, held)};
  result.bare.one = !rotors_differ(task);
  return result;
}

std::optional<WithoutBalls> without_balls(const OneBodyTask& task) {
  const OneBodyRunner runner(task);
  const auto bare = runner.runs(false, 0, std::min(task.starts, bare_runs_needed(task))),
             held = runner.runs(true, 0, std::min(task.starts, most_held_starts));
  if (is_set(task.stop)) return std::nullopt;
  return counted_runs(task, bare, held);
}

namespace {
void refuse_starts(const Study& study, const BasinOptions& options) {
  const auto refuse = [&](const char* what) {
    throw InputError(study.name, "balancer.balls", "0",
                     fmt::format("leaves no starts for {}; must be 1 to {} with that", what, model::max_balls));
  };
  if (!options.output.empty()) refuse("an output file");
  if (!options.initial.empty()) refuse("starts of your own");
  if (options.half_width > 0.0) refuse("a half-width");
  if (study.sampling.method == SamplingMethod::grid) refuse("sampling.method = \"grid\"");
}
}  // namespace

BasinResult bare_basin(const Study& study, const BasinOptions& options) {
  const RunClock clock;
  check(study);
  refuse_starts(study, options);
  BasinResult result;
  result.study = as_sampled(study);
  const Sampler sampler = sampler_of(result.study);
  note_machine(result, options);
  result.note = "there are no balls";
  if (options.keep_starts) result.every_start.emplace();
  const OneBodyTask task{result.study, sampler, 0, {}, result.threads, options.stop};
  const bool differ = rotors_differ(task);
  OneBodyRuns runs =
      counted(task, one_body_runs(task, false, 0, differ ? std::min(study.sampling.starts, most_bare_runs) : 1));
  runs.one = !differ;
  result.partial = is_set(options.stop);
  if (!result.partial) result.without_balls = WithoutBalls{std::move(runs), {}};
  result.took(clock.time());
  return result;
}

}  // namespace equipoise
