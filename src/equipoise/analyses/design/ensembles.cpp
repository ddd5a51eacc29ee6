// Candidates side by side, on threads and helping processes.
#include "equipoise/analyses/design/ensembles.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"

namespace equipoise {

namespace {

constexpr std::chrono::milliseconds until_a_look{10};

std::string name_of_sample(const WantedSample& w) {
  return fmt::format("{} starts, seed {}{}: {}", w.starts, w.seed, w.whole ? ", whole search" : "",
                     text_of(w.settings));
}

}  // namespace

DesignEnsembles::DesignEnsembles(const DesignProblem& problem, const RunOptions& options, DesignFile* file,
                                 const SurveyHelpers& helpers, std::function<bool()> search_time)
    : options_(options),
      file_(file),
      search_time_(std::move(search_time)),
      candidate_options_(options),
      threads_(thread_count(options.threads)) {
  if (search_time_) {
    candidate_options_.stop = &cut_;
    clock_ = std::thread([this] { watch_time(); });
  }
  try {
    survey_ = candidate_survey(std::make_shared<CandidateRunner>(problem, candidate_options_));
  } catch (...) {
    end_clock();
    throw;
  }
  if (helpers)
    helpers_ = std::async(std::launch::async, [this, helpers] {
      try {
        helpers(*this);
      } catch (...) {
        fail(std::current_exception());
      }
    });
}

DesignEnsembles::~DesignEnsembles() { end_clock(); }

void DesignEnsembles::end_clock() {
  over_ = true;
  if (clock_.joinable()) clock_.join();
}

void DesignEnsembles::watch_time() {
  while (!over_) {
    {
      const std::lock_guard guard(taking_);
      if (stopped() || out_of_time()) cut_ = true;
    }
    std::this_thread::sleep_for(until_a_look);
  }
}

void DesignEnsembles::after_search() {
  const std::lock_guard guard(taking_);
  searching_ = false;
  cut_ = stopped();
}

void DesignEnsembles::fail(std::exception_ptr thrown) {
  const std::lock_guard guard(taking_);
  if (!failure_) failure_ = std::move(thrown);
}

void DesignEnsembles::end() {
  over_ = true;
  if (helpers_.valid()) helpers_.get();
  if (failure_) std::rethrow_exception(failure_);
}

std::optional<std::size_t> DesignEnsembles::next_block() {
  const std::lock_guard guard(taking_);
  while (next_ < batch_.size() && answers_[next_]) ++next_;
  if (next_ >= batch_.size() || stopped() || out_of_time() || failure_) return std::nullopt;
  return asked_ + next_++;
}

CellRecord DesignEnsembles::known(std::size_t number) const {
  const std::lock_guard guard(taking_);
  const std::size_t k = number - asked_;
  return k < batch_.size() ? record_of(batch_[k]) : CellRecord{};
}

void DesignEnsembles::deliver(std::size_t number, const CellRecord& made) {
  auto kept = io::sample_from(made);
  const std::lock_guard guard(taking_);
  const std::size_t k = number - asked_;
  if (k >= batch_.size() || answers_[k]) return;
  if (file_) file_->append(number, name_of_sample(batch_[k]), kept.sample);
  answers_[k] = std::move(kept.sample);
  some_known_ = true;
  answered_.notify_all();
}

void DesignEnsembles::work_off(std::size_t missing) {
  if (missing == 0) return;
  const int at_once = std::min(static_cast<int>(missing), threads_);
  const BlockWorkers workers{.threads = threads_ / at_once,
                             .stop = candidate_options_.stop,
                             .known = [this](std::size_t number) { return known(number); },
                             .deliver = [this](std::size_t number, const CellRecord& made) { deliver(number, made); }};
  in_parallel(at_once, static_cast<std::size_t>(at_once), [&](std::size_t) {
    try {
      while (const auto number = next_block())
        if (!survey_(*number, workers)) return;
    } catch (...) {
      fail(std::current_exception());  // other processes get no further block
      throw;
    }
  });
  std::unique_lock lock(taking_);
  while (!stopped() && !out_of_time() && !failure_ &&
         std::find(answers_.begin(), answers_.end(), std::nullopt) != answers_.end())
    answered_.wait_for(lock, until_a_look);
  if (failure_) std::rethrow_exception(failure_);
}

const DesignSample* DesignEnsembles::known(const WantedSample& wanted) const {
  const auto at = known_.find(name_of_sample(wanted));
  return at == known_.end() ? nullptr : &at->second;
}

std::vector<DesignSample> DesignEnsembles::run(const std::vector<WantedSample>& wanted) {
  std::vector<std::optional<DesignSample>> there(wanted.size());
  std::size_t missing = 0;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (const DesignSample* before = known(wanted[k]))
      there[k] = *before;
    else if (auto kept = file_ ? file_->sample(asked_ + k, name_of_sample(wanted[k])) : std::nullopt)
      there[k] = std::move(*kept), ++resumed_, some_known_ = true;
    else
      ++missing;
  }
  std::unique_lock lock(taking_);
  batch_ = wanted;
  answers_ = std::move(there);
  next_ = 0;
  lock.unlock();
  work_off(missing);
  lock.lock();
  asked_ += wanted.size();
  batch_.clear();
  std::vector<DesignSample> samples;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    if (!answers_[k]) continue;
    if (known_.emplace(name_of_sample(wanted[k]), *answers_[k]).second) trajectories_ += wanted[k].starts;
    samples.push_back(std::move(*answers_[k]));
  }
  if (samples.size() < wanted.size()) throw SearchOver();
  return samples;
}

}  // namespace equipoise
