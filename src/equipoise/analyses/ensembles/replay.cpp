// Decides one start of an ensemble by itself.
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

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

}  // namespace equipoise
