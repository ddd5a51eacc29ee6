// One attractor search, and states decided by it.
#include "equipoise/analyses/mapper/mapper.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/machine/balance/room_in_race.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

namespace {

// Keeps deciding after the stop flag and callbacks of its search are gone: searches with `options` first and finds the
// result again in `found`.
Session lasting_session(const Study& study, const MapperOptions& options, AttractorSearchCache& found) {
  AttractorSearchSettings search{.threads = thread_count(options.threads),
                                 .stop = options.stop,
                                 .cache = &found,
                                 .progress = options.progress,
                                 .mode = options.search};
  const bool searches = study.uncertain.empty();
  if ((searches && search_attractors(study, search).stopped) || is_set(options.stop))
    throw RunError("stopped before the attractors were known");
  search.stop = nullptr;
  search.progress = nullptr;
  return {study, search, options.transients};
}

void check_states(const Study& study, std::span<const InitialState> given) {
  check_takes_starts(study);
  check_given_starts(study, given);
}

void check_angles(const Study& study, const std::vector<double>& phi) {
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  if (phi.size() % balls != 0)
    throw InputError("ball angles", "", fmt::format("{} numbers", phi.size()),
                     fmt::format("must be {} a start", balls));
  for (const double angle : phi)
    if (!std::isfinite(angle)) throw InputError("ball angles", "", fmt::format("{}", angle), "must be finite numbers");
}

}  // namespace

struct Mapper::State {
  State(const Study& given, const MapperOptions& options)
      : study(as_sampled(given)),
        gathers(options.transients),
        target(cpu_target()),
        session(lasting_session(study, options, options.searches ? *options.searches : found)),
        catalogue(session) {}

  void settle(Decided& decided) {
    const std::lock_guard guard(listing);
    catalogue.settle(decided);
  }

  const Study study;
  const bool gathers;  // transients
  AttractorSearchCache found;
  const std::string target;
  const Session session;
  RunCatalogue catalogue;
  mutable std::mutex listing;  // while motions are listed
};

Mapper::Mapper(const Study& study, const MapperOptions& options) {
  state_ = long_call(options, [&](const MapperOptions& o) {
    check_runnable(study, o.transients);
    return std::make_unique<State>(study, o);
  });
}

Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

Outcome Mapper::operator()(const InitialState& start) const {
  const std::span<const InitialState> alone(&start, 1);
  check_states(state_->study, alone);
  Decided decided;
  state_->session.decide(alone, decided);
  state_->settle(decided);
  return decided.outcomes.front();
}

std::vector<Outcome> Mapper::operator()(const std::vector<InitialState>& starts, const RunOptions& options) const {
  check_states(state_->study, starts);
  return long_call(options, [&](const RunOptions& o) {
    const auto decide = [&](Chunk& c) { return state_->session.decide({&starts[c.first], c.count}, c); };
    std::vector<Outcome> outcomes;
    take_chunks({.decide = decide, .threads = thread_count(o.threads), .stop = o.stop}, 0, starts.size(),
                [&](Chunk& c) {
                  state_->settle(c);
                  outcomes.insert(outcomes.end(), c.outcomes.begin(), c.outcomes.end());
                  if (o.progress) o.progress({outcomes.size(), starts.size(), "starts", {}});
                  return true;
                });
    return outcomes;
  });
}

Decided Mapper::at_angles(const std::vector<double>& phi) const {
  const Study& study = state_->study;
  check_takes_starts(study);
  check_angles(study, phi);
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  const std::size_t count = phi.size() / balls;
  std::vector<InitialState> given;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < count; ++i) {
    InitialState start = study.initial;
    std::copy_n(&phi[i * balls], balls, start.phi.begin());
    if (model::overlap(study.parameters, start.phi.data())) continue;
    given.push_back(start);
    places.push_back(i);
  }
  Decided those;
  if (!given.empty()) state_->session.decide(given, those);
  state_->settle(those);
  Outcome none;
  none.kind = OutcomeKind::failed;
  none.time = std::numeric_limits<double>::quiet_NaN();
  Decided all{phi, std::vector<Outcome>(count, none), {}, std::vector<TransientRow>(state_->gathers ? count : 0)};
  for (std::size_t k = 0; k < places.size(); ++k) {
    all.outcomes[places[k]] = those.outcomes[k];
    if (state_->gathers) all.transients[places[k]] = those.transients[k];
  }
  return all;
}

Decided Mapper::starts(std::uint64_t first, std::size_t count) const {
  const Sampler sampler = sampler_of(state_->study);
  if (sampler.grid() && (first > sampler.grid()->starts() || count > sampler.grid()->starts() - first))
    throw InputError(state_->study.name, "start index", fmt::format("{}", first + count),
                     fmt::format("must be at most {}, the starts of this grid", sampler.grid()->starts()));
  Decided decided;
  state_->session.decide(first, count, decided);
  state_->settle(decided);
  return decided;
}

const AttractorSearchCache& Mapper::search() const { return state_->found; }

const std::string& Mapper::target() const { return state_->target; }

BalanceNote Mapper::balance() const { return state_->session.balance(); }

const Study& Mapper::study() const { return state_->study; }

std::string Mapper::name(int attractor) const {
  const std::lock_guard guard(state_->listing);
  const Attractor* found = state_->catalogue.find(attractor);
  return found ? found->name : "";
}

std::string Mapper::name(const Outcome& outcome) const {
  return outcome.kind == OutcomeKind::attracted ? name(outcome.attractor) : name_of(outcome.kind);
}

Catalogue Mapper::attractors() const {
  const std::lock_guard guard(state_->listing);
  return state_->catalogue;
}

}  // namespace equipoise
