// Blocks one after the other on each thread.
#include "equipoise/analyses/sweeps/survey_run.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

SurveyRun::SurveyRun(const RunOptions& options) : threads_(thread_count(options.threads)), stop_(options.stop) {}

std::optional<std::size_t> SurveyRun::next_block() {
  if (stopped()) return std::nullopt;  // without counting a block as begun
  const std::size_t next = next_++;
  if (next >= blocks_.size()) return std::nullopt;
  return blocks_[next];
}

std::span<const std::size_t> SurveyRun::begun() const {
  return {blocks_.data(), std::min(next_.load(), blocks_.size())};
}

std::exception_ptr SurveyRun::work(const Survey& survey, std::vector<std::size_t> blocks, SearchLog* notes,
                                   const SurveyHelpers& helpers) {
  blocks_ = std::move(blocks);
  const std::size_t at_once = std::min<std::size_t>(blocks_.size(), static_cast<std::size_t>(threads_));
  const int each = at_once > 0 ? threads_ / static_cast<int>(at_once) : 1;
  working_ = static_cast<int>(at_once);
  idle_ = threads_ - each * working_;
  const BlockWorkers workers{.threads = each,
                             .idle = [this] { return idle_ / std::max(1, working_.load()); },
                             .help = &ensembles_,
                             .stop = stop_,
                             .notes = notes,
                             .known = [this](std::size_t cell) { return known(cell); },
                             .deliver = [this](std::size_t cell, const CellRecord& made) { deliver(cell, made); }};
  std::vector<std::thread> crew;
  for (int k = 0; k < idle_; ++k) crew.emplace_back([this] { help(); });
  for (std::size_t k = 0; k < at_once; ++k) crew.emplace_back([&] { work_along(survey, workers); });
  guarded([&] {
    if (helpers) helpers(*this);
  });
  for (std::thread& worker : crew) worker.join();
  return failure_;
}

void SurveyRun::work_along(const Survey& survey, const BlockWorkers& workers) {
  guarded([&] {
    while (const auto block = next_block())
      if (!survey(*block, workers)) break;
  });
  idle_ += workers.threads;
  --working_;
  std::vector<std::thread> helpers;
  for (int k = 1; k < workers.threads; ++k) helpers.emplace_back([this] { help(); });
  help();
  for (std::thread& helper : helpers) helper.join();
}

// A thread without a block, for as long as another has one.
void SurveyRun::help() {
  constexpr std::chrono::milliseconds until_a_look{5};
  guarded([&] {
    while (!idle() && !stopped())
      if (!ensembles_.help()) std::this_thread::sleep_for(until_a_look);
  });
}

// What one thread throws ends the work of all.
void SurveyRun::guarded(const std::function<void()>& call) {
  try {
    call();
  } catch (...) {
    const std::lock_guard guard(failing_);
    if (!failure_) failure_ = std::current_exception();
    failed_ = true;
  }
}

}  // namespace equipoise
