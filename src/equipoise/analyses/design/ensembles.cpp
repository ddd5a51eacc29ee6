// Runs each candidate from the same starts, its search beginning with what the study's had; keeps what was run.
#include "equipoise/analyses/design/ensembles.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/study/contents/below_resonance.hpp"
#include "equipoise/study/toml/toml_tree.hpp"

namespace equipoise {

namespace {

// Searches that a thread keeps: spin-ups to one speed share one, other candidates come back to theirs soon or never.
constexpr std::size_t most_attractor_searches = 16;

// As if it came from no text.
StudyValue without_lines(const StudyValue& value) {
  if (const StudyValue::Table* members = value.table()) {
    StudyValue table;
    for (const auto& [key, member] : *members) table.set(key, without_lines(member));
    return table;
  }
  if (const StudyValue::Array* entries = value.array()) {
    StudyValue::Array array;
    for (const StudyValue& entry : *entries) array.push_back(without_lines(entry));
    return array;
  }
  StudyValue plain = value;
  plain.set_line(0);
  return plain;
}

class CandidateRunner {
 public:
  /// Searches the study as it is.
  CandidateRunner(const DesignProblem& problem, const RunOptions& options);

  /// None if stopped. Thread-safe.
  std::optional<DesignSample> run(const WantedSample& wanted, const BlockWorkers& workers);

 private:
  // What a thread keeps of the final speeds it has met.
  struct Met {
    AttractorSearchCache searches;
    std::map<std::string, bool> balances;  // by attractor_search_subject(): whether a balanced state attracts
  };
  bool balances(const Study& study, const StopFlag* stop, Met& met) const;
  std::optional<DesignSample> run(const WantedSample& wanted, const BlockWorkers& workers, Met& met) const;

  const DesignProblem& problem_;
  // Of the study as it is: where the searches of all candidates begin.
  std::vector<std::vector<double>> warm_start_states_;
  WarmStartLevels warm_start_levels_;
  std::mutex taking_;
  std::vector<std::unique_ptr<Met>> free_;
};

// The study's search is made again by every run: what a file keeps are answers. Rotors that each start draws have
// searches of their own.
CandidateRunner::CandidateRunner(const DesignProblem& problem, const RunOptions& options) : problem_(problem) {
  const Study study = problem_.study_of({}, problem_.first_look(), problem_.study().sampling.seed);
  if (!study.uncertain.empty() || runs_below_resonance(study)) return;
  BasinOptions run;
  run.threads = thread_count(options.threads);
  run.stop = options.stop;
  run.transients = false;
  run.search_serves = starts_of_a_first_look;
  Catalogue catalogue;
  basin(study, run, &catalogue, &warm_start_levels_);
  for (const Attractor& a : catalogue.attractors())
    if (const auto& state = a.motion.state; state.size() > 0)
      warm_start_states_.emplace_back(state.data(), state.data() + state.size());
}

bool CandidateRunner::balances(const Study& study, const StopFlag* stop, Met& met) const {
  const std::string subject = attractor_search_subject(study);
  if (const auto at = met.balances.find(subject); at != met.balances.end()) return at->second;
  const bool stable = analyse_balanced(study.system(), stop).stable;
  if (!is_set(stop)) met.balances.emplace(subject, stable);
  return stable;
}

std::optional<DesignSample> CandidateRunner::run(const WantedSample& wanted, const BlockWorkers& workers) {
  std::unique_lock lock(taking_);
  if (free_.empty()) free_.push_back(std::make_unique<Met>());
  std::unique_ptr<Met> met = std::move(free_.back());
  free_.pop_back();
  lock.unlock();
  std::optional<DesignSample> sample = run(wanted, workers, *met);
  lock.lock();
  free_.push_back(std::move(met));
  return sample;
}

std::optional<DesignSample> CandidateRunner::run(const WantedSample& wanted, const BlockWorkers& workers,
                                                 Met& met) const {
  std::optional<Study> study;
  try {
    study = problem_.study_of(wanted.settings, wanted.starts, wanted.seed);
    check_runnable(*study, problem_.transients());
  } catch (const InputError& e) {  // values that make a study each by itself, but not together
    DesignSample none;
    none.note = e.what();
    return none;
  }
  const bool hopeless_unbalanced = !problem_.by_outcome() || (problem_.requires_balance() && !study->speed.driven());
  if (hopeless_unbalanced &&
      (runs_below_resonance(*study) || (study->uncertain.empty() && !balances(*study, workers.stop, met)))) {
    if (is_set(workers.stop)) return std::nullopt;
    return sample_without_balance(problem_.figures(), wanted.starts, *study, wanted.settings);
  }
  if (met.searches.made.size() > most_attractor_searches) met.searches.made.clear();
  if (met.balances.size() > most_attractor_searches) met.balances.clear();
  BasinOptions run;
  workers.work_on(run);
  run.transients = problem_.transients();
  run.without_balls = false;
  run.keep_starts = true;
  run.searches = &met.searches;
  if (!wanted.whole) run.search_serves = starts_of_a_first_look;
  const std::size_t dimension = static_cast<std::size_t>(study->system().dimension());
  for (const std::vector<double>& state : warm_start_states_)
    if (state.size() == dimension) run.warm_start_states.push_back(state);
  if (!run.warm_start_states.empty()) {
    run.search = SearchMode::warm;
    run.warm_start_levels = &warm_start_levels_;
  }
  const BasinResult result = basin(*study, run);
  if (result.partial) return std::nullopt;
  return sample_of(problem_.figures(), result, *study, wanted.settings);
}

WantedSample wanted_from(const CellRecord& record) {
  const StudyValue tree = study::parse_toml(std::string(record.begin(), record.end()));
  const auto number = [&](const char* key) { return static_cast<std::uint64_t>(*tree.find_path(key)->integer()); };
  WantedSample wanted{
      {}, number("ensemble.starts"), number("ensemble.seed"), *tree.find_path("ensemble.whole")->boolean()};
  for (const auto& [name, setting] : *tree.table())
    if (const StudyValue* key = setting.find("key"))
      wanted.settings.push_back({*key->string(), without_lines(*setting.find("value"))});
  return wanted;
}

}  // namespace

std::string WantedSample::name() const {
  return fmt::format("{} starts, seed {}{}: {}", starts, seed, whole ? ", whole search" : "", text_of(settings));
}

CellRecord WantedSample::record() const {
  StudyValue tree{{"ensemble", {{"starts", starts}, {"seed", seed}, {"whole", whole}}}};
  for (std::size_t k = 0; k < settings.size(); ++k)
    tree.set(fmt::format("setting_{:02}", k), StudyValue{{"key", settings[k].key}, {"value", settings[k].value}});
  const std::string text = study::toml_text(tree);
  return {text.begin(), text.end()};
}

Survey design_survey(const DesignProblem& problem, const RunOptions& options) {
  return
      [runner = std::make_shared<CandidateRunner>(problem, options)](std::size_t number, const BlockWorkers& workers) {
        const CellRecord asked = workers.known(number);
        const auto made = asked.empty() ? std::nullopt : runner->run(wanted_from(asked), workers);
        if (made) workers.deliver(number, io::bytes_of(KeptSample{"", *made}));
        return made.has_value();
      };
}

DesignEnsembles::DesignEnsembles(const DesignProblem& problem, const DesignOptions& options, io::CellFile* file,
                                 KeptSamples kept)
    : SurveyRun(options), search_time_(options.search_time_over), kept_(std::move(kept)) {
  // Candidates end with the search's time, so that a costly one cannot take the time of the checks as well.
  if (search_time_) out_of_time_ = [this] { return out_of_time(); };
  open(design_survey(problem, options), file);
}

CellRecord DesignEnsembles::record(std::size_t number) const {
  const std::size_t k = number - asked_;
  return k < batch_.size() ? batch_[k].record() : CellRecord{};
}

CellRecord DesignEnsembles::take(std::size_t number, const CellRecord& made) {
  const std::size_t k = number - asked_;
  if (k >= batch_.size() || answers_[k]) return {};
  answers_[k] = io::sample_from(made).sample;
  some_known_ = true;
  return io::bytes_of(kept_[number] = {batch_[k].name(), *answers_[k]});
}

const DesignSample* DesignEnsembles::sample(const WantedSample& wanted) const {
  const auto at = samples_.find(wanted.name());
  return at == samples_.end() ? nullptr : &at->second;
}

std::vector<DesignSample> DesignEnsembles::run(const std::vector<WantedSample>& wanted) {
  std::vector<std::optional<DesignSample>> there(wanted.size());
  std::vector<std::size_t> missing;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const auto kept = kept_.find(asked_ + k);
    if (const DesignSample* before = sample(wanted[k]))
      there[k] = *before;
    else if (kept != kept_.end() && kept->second.name == wanted[k].name())
      there[k] = kept->second.sample, ++resumed_, some_known_ = true;
    else
      missing.push_back(asked_ + k);
  }
  {
    const std::lock_guard guard(taking_);
    batch_ = wanted;
    answers_ = std::move(there);
  }
  work(std::move(missing));
  constexpr std::chrono::milliseconds until_a_look{20};  // between checks for a stop, which wakes no thread
  std::unique_lock lock(taking_);
  while (std::find(answers_.begin(), answers_.end(), std::nullopt) != answers_.end() && !stopped() && !out_of_time())
    delivered_.wait_for(lock, until_a_look);
  asked_ += wanted.size();
  batch_.clear();
  std::vector<DesignSample> samples;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (!answers_[k]) continue;
    if (samples_.emplace(wanted[k].name(), *answers_[k]).second) trajectories_ += wanted[k].starts;
    samples.push_back(std::move(*answers_[k]));
  }
  if (samples.size() < wanted.size()) throw SearchOver();
  return samples;
}

}  // namespace equipoise
