// Runs candidates in parallel, each as an ensemble of the same starts.
#include "equipoise/design/ensembles.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

#include <fmt/format.h>

#include "equipoise/attractors/catalogue.hpp"
#include "equipoise/balanced_regions/balanced_analysis.hpp"
#include "equipoise/base/error.hpp"
#include "equipoise/design/search.hpp"
#include "equipoise/design/settings.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/running/parallel.hpp"
#include "equipoise/start_runs/checks.hpp"

namespace equipoise {

namespace {

// Attractor searches that a thread keeps. Spin-ups to one final speed share one; others rarely return to theirs.
constexpr std::size_t most_attractor_searches = 16;

std::string name_of_sample(const WantedSample& w) {
  return fmt::format("{} starts, seed {}: {}", w.starts, w.seed, text_of(w.settings));
}

}  // namespace

DesignEnsembles::DesignEnsembles(const DesignProblem& problem, const RunOptions& options, DesignFile* file)
    : problem_(problem),
      options_(options),
      file_(file),
      threads_(thread_count(options.threads)),
      met_(static_cast<std::size_t>(threads_)) {
  begin_with_study();
}

// Every run repeats this search, since a file keeps only answers. With uncertain values each start has its own search.
void DesignEnsembles::begin_with_study() {
  const Study study = problem_.study_of({}, problem_.first_look(), problem_.study().sampling.seed);
  if (!study.uncertain.empty()) return;
  BasinOptions run;
  run.threads = threads_;
  run.stop = options_.stop;
  run.transients = false;
  Catalogue catalogue;
  basin(study, run, &catalogue, &hints_);
  for (const Attractor& a : catalogue.attractors())
    if (const auto& state = a.motion.state; state.size() > 0)
      seeds_.emplace_back(state.data(), state.data() + state.size());
}

bool DesignEnsembles::balances(const Study& study, Met& met) const {
  const std::string subject = attractor_search_subject(study);
  if (const auto at = met.balances.find(subject); at != met.balances.end()) return at->second;
  const bool stable = analyse_balanced(study.system(), options_.stop).stable;
  if (!stopped()) met.balances.emplace(subject, stable);
  return stable;
}

DesignSample DesignEnsembles::one(const WantedSample& wanted, int threads, Met& met, bool& complete) const {
  complete = true;
  std::optional<Study> study;
  try {
    study = problem_.study_of(wanted.settings, wanted.starts, wanted.seed);
    check_runnable(*study, problem_.transients());
  } catch (const InputError& e) {  // values that are valid one by one, but not together
    DesignSample none;
    none.note = e.what();
    return none;
  }
  if (!problem_.by_outcome() && study->uncertain.empty() && !balances(*study, met)) {
    complete = !stopped();
    return sample_without_balance(problem_.figures(), wanted.starts, *study, wanted.settings);
  }
  if (met.discoveries.made.size() > most_attractor_searches) met.discoveries.made.clear();
  if (met.balances.size() > most_attractor_searches) met.balances.clear();
  BasinOptions run;
  run.threads = threads;
  run.stop = options_.stop;
  run.transients = problem_.transients();
  run.keep_starts = true;
  run.discoveries = &met.discoveries;
  const std::size_t dimension = static_cast<std::size_t>(study->system().dimension());
  for (const std::vector<double>& seed : seeds_)
    if (seed.size() == dimension) run.warm_start_states.push_back(seed);
  run.warm_start = !run.warm_start_states.empty();
  if (run.warm_start) run.warm_start_levels = &hints_;
  const BasinResult result = basin(*study, run);
  complete = !result.partial;
  return sample_of(problem_.figures(), result, *study, wanted.settings);
}

void DesignEnsembles::work_off(const std::vector<WantedSample>& wanted, std::vector<std::size_t>& missing,
                               std::vector<DesignSample>& samples) {
  if (missing.empty()) return;
  const int at_once = std::min(static_cast<int>(missing.size()), threads_);
  std::mutex taking;
  std::vector<Met*> free;
  for (Met& met : met_) free.push_back(&met);
  std::atomic<bool> lost{false};
  std::vector<char> done(missing.size(), 0);
  in_parallel(at_once, missing.size(), [&](std::size_t k) {
    if (lost || stopped()) lost = true;
    if (lost) return;
    const WantedSample& w = wanted[missing[k]];
    std::unique_lock lock(taking);
    Met& met = *free.back();
    free.pop_back();
    lock.unlock();
    bool complete = false;
    DesignSample sample = one(w, threads_ / at_once, met, complete);
    lock.lock();
    free.push_back(&met);
    if (!complete) lost = true;
    if (!complete) return;
    if (file_) file_->append(asked_ + missing[k], name_of_sample(w), sample);
    samples[missing[k]] = std::move(sample);
    done[k] = 1;
  });
  std::vector<std::size_t> left;
  for (std::size_t k = 0; k < missing.size(); ++k)
    if (!done[k]) left.push_back(missing[k]);
  missing = std::move(left);
}

const DesignSample* DesignEnsembles::known(const WantedSample& wanted) const {
  const auto at = known_.find(name_of_sample(wanted));
  return at == known_.end() ? nullptr : &at->second;
}

std::vector<DesignSample> DesignEnsembles::run(const std::vector<WantedSample>& wanted) {
  std::vector<DesignSample> samples(wanted.size());
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const std::string name = name_of_sample(wanted[k]);
    const std::uint64_t number = asked_ + k;
    if (const auto at = known_.find(name); at != known_.end())
      samples[k] = at->second;
    else if (auto kept = file_ ? file_->sample(number, name) : std::nullopt)
      samples[k] = std::move(*kept), ++resumed_;
    else
      missing.push_back(k);
  }
  work_off(wanted, missing, samples);
  asked_ += wanted.size();
  for (std::size_t k = 0; k < wanted.size(); ++k)
    if (std::find(missing.begin(), missing.end(), k) == missing.end() &&
        known_.emplace(name_of_sample(wanted[k]), samples[k]).second)
      trajectories_ += wanted[k].starts;
  if (!missing.empty()) throw SearchOver();
  return samples;
}

}  // namespace equipoise
