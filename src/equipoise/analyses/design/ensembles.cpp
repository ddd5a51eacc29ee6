// Candidates side by side, on threads and helping processes.
#include "equipoise/analyses/design/ensembles.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "equipoise/analyses/design/search.hpp"

namespace equipoise {

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
