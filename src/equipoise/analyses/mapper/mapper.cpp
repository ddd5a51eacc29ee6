// One attractor search, and states decided by it.
#include "equipoise/analyses/mapper/mapper.hpp"

#include <mutex>
#include <span>
#include <utility>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

struct Mapper::State {
  State(const Study& given, const RunOptions& options)
      : study(with_horizon(given)),
        target(cpu_target()),
        session(lasting_session(study, options, false, found)),
        catalogue(session) {}

  void settle(Decided& decided) {
    const std::lock_guard guard(listing);
    catalogue.settle(decided);
  }

  const Study study;
  AttractorSearchCache found;
  const std::string target;
  const Session session;
  RunCatalogue catalogue;
  mutable std::mutex listing;  // while motions are listed
};

Mapper::Mapper(const Study& study, const RunOptions& options) {
  const ChosenCpuTarget chosen(options.cpu_target);
  state_ = reported(options, [&](const RunOptions& o) {
    check_takes_starts(study);
    check_runnable(study, false);
    return std::make_unique<State>(study, o);
  });
}

Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

Fate Mapper::operator()(const InitialState& start) const {
  const std::span<const InitialState> alone(&start, 1);
  check_given_starts(state_->study, alone);
  Decided decided;
  state_->session.decide(alone, decided);
  state_->settle(decided);
  return decided.fates.front();
}

std::vector<Fate> Mapper::operator()(const std::vector<InitialState>& starts, const RunOptions& options) const {
  check_given_starts(state_->study, starts);
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, [&](const RunOptions& o) {
    const auto decide = [&](Chunk& c) { return state_->session.decide({&starts[c.first], c.count}, c); };
    std::vector<Fate> fates;
    take_chunks({.decide = decide, .threads = thread_count(o.threads), .stop = o.stop}, 0, starts.size(),
                [&](Chunk& c) {
                  state_->settle(c);
                  fates.insert(fates.end(), c.fates.begin(), c.fates.end());
                  if (o.progress) o.progress({fates.size(), starts.size(), "starts", {}});
                  return true;
                });
    return fates;
  });
}

const AttractorSearchCache& Mapper::search() const { return state_->found; }
const std::string& Mapper::target() const { return state_->target; }

const Study& Mapper::study() const { return state_->study; }

std::string Mapper::name(int attractor) const {
  const std::lock_guard guard(state_->listing);
  const Attractor* found = state_->catalogue.find(attractor);
  return found ? found->name : "";
}

std::string Mapper::name(const Fate& fate) const {
  return fate.outcome == Outcome::attracted ? name(fate.attractor) : name_of(fate.outcome);
}

Catalogue Mapper::attractors() const {
  const std::lock_guard guard(state_->listing);
  return state_->catalogue;
}

}  // namespace equipoise
