// Takes cells in, keeps and reports them.
#include "equipoise/analyses/sweeps/sweep.hpp"

#include <exception>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/sweeps/attractor_labels.hpp"
#include "equipoise/analyses/sweeps/survey_run.hpp"
#include "equipoise/analyses/sweeps/sweep_cell.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/core/running/reporting.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise {

namespace {

class SweepRun final : public SurveyRun {
 public:
  SweepRun(const SweepPlan& plan, const SweepOptions& options) : SurveyRun(options), plan_(plan), options_(options) {
    result_.study = plan.study();
    result_.axes = plan.axes();
    result_.identity = plan.identity();
    result_.cells.resize(plan.cells());
    result_.half_width = plan.request().half_width;
    result_.transients = plan.transients();
    result_.threads = threads_;
    result_.cpu_target = cpu_target();
  }

  SweepResult run() {
    const RunClock clock;
    if (!options_.output.empty()) file_ = io::open_sweep_file(options_.output, result_.identity, result_.cells);
    if (file_) give_notice(options_, file_->loss());
    const std::vector<std::size_t> blocks = blocks_to_do();
    report();
    const std::exception_ptr failure =
        work(sweep_survey(plan_), blocks, file_ ? &file_->notes() : nullptr, options_.helpers);
    label_attractors(result_.axes, result_.cells);
    result_.took(clock.time());
    if (failure) std::rethrow_exception(failure);  // what is done is kept beside the output
    if (file_) io::finish_sweep_file(*file_, result_);
    return std::move(result_);
  }

  CellRecord known(std::size_t cell) const override {
    const std::lock_guard guard(taking_);
    const auto& there = result_.cells[cell];
    return there ? io::bytes_of(*there) : CellRecord{};
  }

  void deliver(std::size_t index, const CellRecord& made) override {
    auto cell = std::make_shared<SweepCell>(io::cell_from(made));
    const std::lock_guard guard(taking_);
    if (result_.cells[index]) return;
    if (file_) file_->append(index, made);
    result_.cells[index] = std::move(cell);
    ++done_;
    if (options_.cell) options_.cell(index, *result_.cells[index]);
    report();
  }

 private:
  // Those of this shard in which something is missing.
  std::vector<std::size_t> blocks_to_do() {
    std::vector<std::size_t> blocks;
    for (std::size_t block = 0; block < plan_.blocks(); ++block) {
      std::size_t missing = 0;
      const bool ours = block % options_.shards == options_.shard;
      for (const std::size_t cell : plan_.cells_of(block)) missing += !result_.cells[cell];
      result_.resumed_cells += plan_.cells_of(block).size() - missing;
      if (ours) total_ += plan_.cells_of(block).size(), done_ += plan_.cells_of(block).size() - missing;
      if (ours && missing > 0) blocks.push_back(block);
    }
    return blocks;
  }

  void report() const {
    if (options_.progress) options_.progress({done_, total_, "cells", std::nullopt});
  }

  const SweepPlan& plan_;
  const SweepOptions& options_;
  SweepResult result_;
  std::unique_ptr<io::CellFile> file_;
  std::uint64_t done_ = 0, total_ = 0;
  mutable std::mutex taking_;
};

}  // namespace

SweepResult sweep(const SweepPlan& plan, const SweepOptions& options) {
  if (options.shards < 1 || options.shard >= options.shards)
    throw InputError("sweep", "shard", fmt::format("{} of {}", options.shard, options.shards),
                     "must be less than the number of shards");
  const ChosenCpuTarget chosen(options.cpu_target);
  return reported(options, [&](const SweepOptions& o) { return SweepRun(plan, o).run(); });
}

}  // namespace equipoise
