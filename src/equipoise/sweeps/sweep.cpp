// Distributes blocks to threads and helping processes; receives, keeps and reports cells.
#include "equipoise/sweeps/sweep.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/base/error.hpp"
#include "equipoise/cell_files/cell_file.hpp"
#include "equipoise/cell_files/sweep_cells.hpp"
#include "equipoise/cell_files/sweep_file.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/kernels/cpu_target.hpp"
#include "equipoise/running/cpu_time.hpp"
#include "equipoise/running/parallel.hpp"
#include "equipoise/running/reporting.hpp"
#include "equipoise/sweeps/attractor_labels.hpp"
#include "equipoise/sweeps/cell_desk.hpp"
#include "equipoise/sweeps/sweep_cell.hpp"

namespace equipoise {

namespace {

class SweepRun final : public SweepWork {
 public:
  SweepRun(const SweepPlan& plan, const SweepOptions& options) : plan_(plan), options_(options) {
    result_.study = plan.study();
    result_.axes = plan.axes();
    result_.identity = plan.identity();
    result_.cells.resize(plan.cells());
    result_.half_width = plan.request().half_width;
    result_.transients = plan.transients();
    result_.threads = thread_count(options.threads);
    result_.cpu_target = cpu_target();
  }

  SweepResult run() {
    const auto begin = std::chrono::steady_clock::now();
    const double cpu_begin = cpu_seconds();
    if (!options_.output.empty()) file_ = io::open_sweep_file(options_.output, result_.identity, result_.cells);
    list_blocks();
    report();
    work();
    label_attractors(result_.axes, result_.cells);
    result_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    result_.cpu_seconds = cpu_seconds() - cpu_begin;
    if (failure_) std::rethrow_exception(failure_);  // finished work is kept beside the output
    if (file_) io::finish_sweep_file(*file_, result_);
    return std::move(result_);
  }

  std::optional<std::size_t> next_block() override {
    const std::size_t next = next_++;
    if (next >= blocks_.size() || stopped()) return std::nullopt;
    return blocks_[next];
  }

  const SweepCell* known(std::size_t cell) const override {
    const std::lock_guard guard(taking_);
    return result_.cells[cell].get();
  }

  void deliver(std::size_t index, SweepCell cell) override {
    const std::lock_guard guard(taking_);
    if (result_.cells[index]) return;
    if (file_) file_->append(index, io::bytes_of(cell));
    result_.cells[index] = std::make_shared<SweepCell>(std::move(cell));
    ++done_;
    if (options_.cell) options_.cell(index, *result_.cells[index]);
    report();
  }

  bool idle() const override { return working_ == 0; }
  CellDesk& desk() override { return desk_; }

 private:
  bool stopped() const { return is_set(options_.stop) || failed_; }

  // Lists this shard's blocks that are incomplete.
  void list_blocks() {
    for (std::size_t block = 0; block < plan_.blocks(); ++block) {
      std::size_t missing = 0;
      const bool ours = block % options_.shards == options_.shard;
      for (const std::size_t cell : plan_.cells_of(block)) missing += !result_.cells[cell];
      result_.resumed_cells += plan_.cells_of(block).size() - missing;
      if (ours) total_ += plan_.cells_of(block).size(), done_ += plan_.cells_of(block).size() - missing;
      if (ours && missing > 0) blocks_.push_back(block);
    }
  }

  // Works on as many blocks at a time as there are threads; with fewer blocks, each has several threads. Threads
  // without a block help with the cells of the others.
  void work() {
    const std::size_t at_once = std::min<std::size_t>(blocks_.size(), static_cast<std::size_t>(result_.threads));
    const int each = at_once > 0 ? result_.threads / static_cast<int>(at_once) : 1;
    working_ = static_cast<int>(at_once);
    idle_ = result_.threads - each * working_;
    std::vector<std::thread> workers;
    for (int k = 0; k < idle_; ++k) workers.emplace_back([this] { help(); });
    for (std::size_t k = 0; k < at_once; ++k) workers.emplace_back([this, each] { work_along(each); });
    guarded([&] {
      if (options_.helpers) options_.helpers(*this);
    });
    for (std::thread& worker : workers) worker.join();
  }

  void work_along(int threads) {
    const auto seen = [this](std::size_t cell) { return known(cell); };
    const auto take = [this](std::size_t index, SweepCell cell) { deliver(index, std::move(cell)); };
    const auto idle = [this] { return idle_ / std::max(1, working_.load()); };
    guarded([&] {
      const BlockWorkers workers{.threads = threads,
                                 .idle = idle,
                                 .desk = &desk_,
                                 .stop = options_.stop,
                                 .notes = file_ ? &file_->notes() : nullptr};
      while (const auto block = next_block())
        if (!run_block(plan_, *block, seen, take, workers)) break;
    });
    idle_ += threads;
    --working_;
    std::vector<std::thread> helpers;
    for (int k = 1; k < threads; ++k) helpers.emplace_back([this] { help(); });
    help();
    for (std::thread& helper : helpers) helper.join();
  }

  // A thread without a block, while another thread has one.
  void help() {
    constexpr std::chrono::milliseconds until_a_look{5};
    guarded([&] {
      while (!idle() && !stopped())
        if (!desk_.help()) std::this_thread::sleep_for(until_a_look);
    });
  }

  // An exception in one thread ends the work of all.
  template <class Call>
  void guarded(const Call& call) {
    try {
      call();
    } catch (...) {
      const std::lock_guard guard(failing_);
      if (!failure_) failure_ = std::current_exception();
      failed_ = true;
    }
  }

  void report() const {
    if (options_.progress) options_.progress({done_, total_, "cells", std::nullopt});
  }

  const SweepPlan& plan_;
  const SweepOptions& options_;
  SweepResult result_;
  std::unique_ptr<io::CellFile> file_;
  std::vector<std::size_t> blocks_;
  std::atomic<std::size_t> next_{0};
  std::atomic<int> working_{0}, idle_{0};  // threads at blocks; threads without one
  CellDesk desk_;
  std::atomic<bool> failed_{false};
  std::uint64_t done_ = 0, total_ = 0;
  mutable std::mutex taking_, failing_;
  std::exception_ptr failure_;
};

}  // namespace

SweepResult sweep(const SweepPlan& plan, const SweepOptions& options) {
  if (options.shards < 1 || options.shard >= options.shards)
    throw InputError("sweep", "shard", fmt::format("{} of {}", options.shard, options.shards),
                     "must be one of as many as there are");
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, [&](const SweepOptions& o) { return SweepRun(plan, o).run(); });
}

}  // namespace equipoise
