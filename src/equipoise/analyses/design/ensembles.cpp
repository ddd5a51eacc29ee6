// Candidates side by side, on threads and helping processes.
#include "equipoise/analyses/design/ensembles.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "equipoise/analyses/design/search.hpp"

namespace equipoise {

DesignEnsembles::DesignEnsembles(const DesignProblem& problem, const DesignOptions& options, io::CellFile* file,
                                 KeptSamples kept)
    : SurveyRun(options), search_time_(options.search_time_over), kept_(std::move(kept)) {
  candidate_options_.threads = options.threads;
  candidate_options_.stop = options.stop;
  if (search_time_) candidate_options_.stop_asked = [this] { return out_of_time(); };
  open(candidate_survey(problem, candidate_options_), file);
}

std::optional<std::size_t> DesignEnsembles::next_block() {
  return out_of_time() ? std::nullopt : SurveyRun::next_block();
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

bool DesignEnsembles::all_answered() const {
  const std::lock_guard guard(taking_);
  return std::find(answers_.begin(), answers_.end(), std::nullopt) == answers_.end();
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
  constexpr std::chrono::milliseconds until_a_look{1};
  while (!all_answered() && !stopped() && !out_of_time()) std::this_thread::sleep_for(until_a_look);
  const std::lock_guard guard(taking_);
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
