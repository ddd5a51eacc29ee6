// One attractor search, and states decided by it.
#include "equipoise/analyses/mapper/mapper.hpp"

#include <atomic>
#include <mutex>
#include <optional>
#include <span>
#include <utility>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/analyses/ensembles/ensemble_runner.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/start_runner.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

struct Mapper::State {
  Study study;
  std::unique_ptr<StartRunner> runner;
  AttractorSearchCache found;
  std::string target;
  mutable std::mutex listing;  // while motions are listed

  void settle(Decided& decided) {
    const std::lock_guard guard(listing);
    runner->settle(decided);
  }
};

Mapper::Mapper(const Study& study, const RunOptions& options) {
  const ChosenCpuTarget chosen(options.cpu_target);
  state_ = reported(options, [&](const RunOptions& o) {
    check_takes_starts(study);
    check_runnable(study, false);
    auto state = std::make_unique<State>();
    state->study = with_horizon(study);
    state->target = cpu_target();
    state->runner = lasting_runner(state->study, o, false, state->found);
    return state;
  });
}

Mapper::~Mapper() = default;
Mapper::Mapper(Mapper&&) noexcept = default;
Mapper& Mapper::operator=(Mapper&&) noexcept = default;

Fate Mapper::operator()(const InitialState& start) const {
  const std::span<const InitialState> alone(&start, 1);
  check_given_starts(state_->study, alone);
  Decided decided;
  state_->runner->run_from(alone, decided);
  state_->settle(decided);
  return decided.fates.front();
}

std::vector<Fate> Mapper::operator()(const std::vector<InitialState>& starts, const RunOptions& options) const {
  check_given_starts(state_->study, starts);
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, [&](const RunOptions& o) {
    const StartRunner& runner = *state_->runner;
    const ChunkWork work{.decide =
                             [&](Chunk& c) {
                               return runner.run_from({&starts[c.first], c.count}, c);
                             },
                         .threads = thread_count(o.threads),
                         .stop = o.stop};
    const std::atomic<bool> finished{false};
    std::atomic<bool> lost{false};
    std::vector<Fate> fates;
    compute_chunks(work, 0, starts.size(), finished, lost, [&](const std::shared_ptr<Chunk>& chunk) {
      state_->settle(*chunk);
      fates.insert(fates.end(), chunk->fates.begin(), chunk->fates.end());
      if (o.progress) o.progress({fates.size(), starts.size(), "starts", {}});
    });
    return fates;
  });
}

const AttractorSearchCache& Mapper::search() const { return state_->found; }
const std::string& Mapper::target() const { return state_->target; }

const Study& Mapper::study() const { return state_->study; }

std::string Mapper::name(int attractor) const {
  const std::lock_guard guard(state_->listing);
  const Attractor* found = state_->runner->catalogue().find(attractor);
  return found ? found->name : "";
}

std::string Mapper::name(const Fate& fate) const {
  return fate.outcome == Outcome::attracted ? name(fate.attractor) : name_of(fate.outcome);
}

Catalogue Mapper::attractors() const {
  const std::lock_guard guard(state_->listing);
  return state_->runner->catalogue();
}

}  // namespace equipoise
