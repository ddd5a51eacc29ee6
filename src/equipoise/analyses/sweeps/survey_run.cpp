// Blocks one after the other on each thread.
#include "equipoise/analyses/sweeps/survey_run.hpp"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/core/running/parallel.hpp"

namespace equipoise {

void BlockWorkers::work_on(BasinOptions& ensemble) const {
  ensemble.threads = threads;
  if (idle) ensemble.search_threads = threads + idle();
  ensemble.help = help;
  ensemble.stop = stop;
  ensemble.stop_asked = stop_asked;
}

SurveyRun::SurveyRun(const SurveyOptions& options) : threads_(thread_count(options.threads)), options_(options) {}

std::optional<std::size_t> SurveyRun::next_block() {
  if (out_of_time_ && out_of_time_()) return std::nullopt;
  const std::lock_guard guard(taking_);
  if (stopped() || next_ >= blocks_.size()) return std::nullopt;  // without counting a block as begun
  return blocks_[next_++];
}

std::span<const std::size_t> SurveyRun::begun() const { return {blocks_.data(), next_}; }

CellRecord SurveyRun::known(std::size_t cell) const {
  const std::lock_guard guard(taking_);
  return record(cell);
}

void SurveyRun::deliver(std::size_t cell, const CellRecord& made) {
  const std::lock_guard guard(taking_);
  const CellRecord taken = take(cell, made);
  if (taken.empty()) return;
  if (file_) file_->append(cell, taken);
  kept(cell);
  delivered_.notify_all();
}

void SurveyRun::open(Survey survey, io::CellFile* file) {
  survey_ = std::move(survey);
  file_ = file;
  if (file) give_notice(options_, file->loss());
  if (options_.helpers)
    helpers_ = std::async(std::launch::async, [this] { guarded([&] { options_.helpers(*this); }); });
}

void SurveyRun::work(std::vector<std::size_t> blocks) {
  const int at_once = static_cast<int>(std::min<std::size_t>(blocks.size(), static_cast<std::size_t>(threads_)));
  {
    const std::lock_guard guard(taking_);
    blocks_ = std::move(blocks);
    next_ = 0;
  }
  if (at_once == 0) return;
  const int each = threads_ / at_once, spare = threads_ - each * at_once;
  working_ = at_once;
  idle_ = spare;
  const BlockWorkers workers{.threads = each,
                             .idle = [this] { return idle_ / std::max(1, working_.load()); },
                             .help = &ensembles_,
                             .stop = options_.stop,
                             .stop_asked = out_of_time_,
                             .notes = file_ ? &file_->notes() : nullptr,
                             .known = [this](std::size_t cell) { return known(cell); },
                             .deliver = [this](std::size_t cell, const CellRecord& made) { deliver(cell, made); }};
  std::vector<std::thread> crew;
  for (int k = 0; k < spare; ++k) crew.emplace_back([this] { help(); });
  for (int k = 0; k < at_once; ++k) crew.emplace_back([&] { work_along(workers); });
  for (std::thread& worker : crew) worker.join();
}

void SurveyRun::dismiss() {
  over_ = true;
  if (helpers_.valid()) helpers_.wait();
}

void SurveyRun::close() {
  dismiss();
  if (failure_) std::rethrow_exception(failure_);
}

void SurveyRun::work_along(const BlockWorkers& workers) {
  guarded([&] {
    while (const auto block = next_block())
      if (!survey_(*block, workers)) break;
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
    while (working_ > 0 && !stopped())
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
