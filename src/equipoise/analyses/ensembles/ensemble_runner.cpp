// Applies an ensemble's options to its study and its search; decides one start by itself; writes the note about open
// starts.
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

Study as_sampled(Study study) {
  study.sampling.method = study.sampling.method.value_or(SamplingMethod::random);
  return with_horizon(std::move(study));
}

bool gathers_transients(const Study& study, const BasinOptions& options) {
  return options.transients.value_or(study.limits.any() || study.standards.any());
}

void take_given_starts(const BasinOptions& options, Study& study) {
  check_takes_starts(study);
  if (options.half_width > 0.0)
    throw InputError("starts of your own", "half_width", fmt::format("{}", options.half_width),
                     "all of them are followed; must be 0");
  const SamplingMethod method = study.sampling.method.value_or(SamplingMethod::random);
  if (method != SamplingMethod::random)
    throw InputError(study.name, "sampling.method", sampling_method_names[static_cast<std::size_t>(method)],
                     "says how starts are drawn, which are given here; must be left out, or \"random\"");
  check_given_starts(study, options.initial);
  study.sampling.method = method;
  study.sampling.starts = options.initial.size();
  study.sampling.box = {};
}

AttractorSearchSettings search_settings(const BasinOptions& options, AttractorSearchCache* searches) {
  return {.threads = options.search_threads > 0 ? options.search_threads : thread_count(options.threads),
          .stop = options.stop,
          .warm_start_states = options.warm_start_states,
          .cache = searches,
          .progress = options.progress,
          .mode = options.search,
          .starts = options.search_serves,
          .warm_start_levels = options.warm_start_levels ? *options.warm_start_levels : WarmStartLevels{},
          .notes = options.notes};
}

InitialState start_of(const Study& study, std::uint64_t index) {
  check(study);
  const Sampler sampler = sampler_of(study);
  if (sampler.grid() && index >= sampler.grid()->starts())
    throw InputError(study.name, "start index", fmt::format("{}", index),
                     fmt::format("must be below {}, the starts of this grid", sampler.grid()->starts()));
  return drawn_start_of(study, sampler, study.sampling.seed, index);
}

namespace {

void check_given(const Study& study, std::uint64_t index, const std::vector<InitialState>& given) {
  check_takes_starts(study);
  if (index >= given.size())
    throw InputError("starts of your own", "index", fmt::format("{}", index),
                     fmt::format("must be below {}, their number", given.size()));
  check_given_starts(study, {&given[index], 1});
}

StartReplay replayed(const Study& study, std::uint64_t index, const BasinOptions& options) {
  const bool gathers = gathers_transients(study, options);
  check_runnable(study, gathers);
  StartReplay replay;
  replay.index = index;
  const bool given = !options.initial.empty();
  if (given) check_given(study, index, options.initial);
  replay.start = given ? options.initial[index] : start_of(study, index);
  replay.drawn = drawn_values(study, sampler_of(study), study.sampling.seed, index);
  const Session session(study, search_settings(options, options.searches), gathers);
  RunCatalogue catalogue(session);
  Decided one;
  if (session.stopped() || !(given ? session.decide({&replay.start, 1}, one) : session.decide(index, 1, one)))
    throw RunError("stopped before the start was decided");
  catalogue.settle(one);
  replay.outcome = one.outcomes.front();
  if (gathers) replay.transients = one.transients.front();
  if (const Attractor* a = catalogue.find(replay.outcome.attractor)) replay.name = a->name;
  return replay;
}

}  // namespace

StartReplay replay_start(const Study& study, std::uint64_t index, const BasinOptions& options) {
  return long_call(options, [&](const BasinOptions& o) { return replayed(study, index, o); });
}

void note_chaos(BasinResult& result, const EscapeRate& chaos) {
  result.chaos = chaos;
  const double time = result.study.scales ? result.study.scales->time() : 1.0;
  const std::string unit = result.study.scales ? " s" : "";
  const char* per = result.study.scales ? "second" : "unit of time";
  const std::string rate =
      chaos.escapes == 0
          ? fmt::format("a rate below {:.2g} per {} and its median lifetime is above {:.2g}{}", chaos.high / time, per,
                        chaos.least * time, unit)
          : fmt::format(
                "a rate of {:.2g} ({:.2g} to {:.2g}) per {} and its median lifetime is {:.2g} ({:.2g} to {:.2g}){}",
                chaos.rate / time, chaos.low / time, chaos.high / time, per, chaos.median * time, chaos.least * time,
                chaos.most * time, unit);
  result.note += (result.note.empty() ? "" : "; ") +
                 fmt::format(
                     "long-lived chaos may end: of the {} starts that were in it, or on a slow approach, after {}, {} "
                     "came to something else later, so they leave it at {}",
                     chaos.trajectories, time_words(result.study, chaos.watched_from, 2), chaos.escapes, rate);
}

void note_open_starts(BasinResult& result, const Horizon& horizon, const LookAt& undecided, const LookAt& stalled) {
  const auto add = [&](const std::string& words) { result.note += (result.note.empty() ? "" : "; ") + words; };
  const double share = result.undecided.share;
  const bool many = result.starts > 0 && share > undecided_worth_a_word;
  const bool may_hold = result.study.speed.driven() && result.study.release.speed;
  const std::vector<UndecidedEnd> ends = many || may_hold ? undecided() : std::vector<UndecidedEnd>{};
  const std::string clamped = clamped_text(ends), clamped_stalled = may_hold ? clamped_text(stalled()) : "";
  if (many) add(fmt::format("{} are undecided: {}", percent_text(share), why_undecided(result.study, horizon, ends)));
  if (!many && !clamped.empty()) add(fmt::format("balls of undecided starts are never released: {}", clamped));
  if (!clamped_stalled.empty()) add(fmt::format("balls of stalled starts are never released: {}", clamped_stalled));
}

}  // namespace equipoise
