// Computes cells from their studies and their neighbours' attractors; takes them in, keeps and reports them.
#include "equipoise/analyses/sweeps/sweep.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/sweeps/attractor_labels.hpp"
#include "equipoise/analyses/sweeps/survey_run.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

SweepOutcome outcome_of(const OutcomeShare& a, const Catalogue& catalogue, int balls) {
  SweepOutcome outcome{a, a.id};
  const Attractor* attractor = catalogue.find(a.id);
  if (!attractor || attractor->motion.state.size() == 0) return outcome;
  const Motion& m = attractor->motion;
  outcome.r_min = m.r_min;
  outcome.r_mean = m.r_mean;
  outcome.r_max = m.r_max;
  outcome.period = m.kind == MotionKind::periodic ? m.period : 0.0;
  outcome.drift.assign(m.drift.begin(), m.drift.begin() + balls);
  outcome.state.assign(m.state.data(), m.state.data() + m.state.size());
  return outcome;
}

SweepCell cell_of(const BasinResult& result, const Catalogue& catalogue) {
  SweepCell cell;
  cell.starts = result.starts;
  for (const OutcomeShare& a : result.attractors)
    cell.outcomes.push_back(outcome_of(a, catalogue, result.study.parameters.balls));
  static_cast<OtherShares&>(cell) = result;
  cell.passed = result.passed;
  if (result.transients) cell.transients = std::make_shared<TransientGroup>(result.transients->groups.front());
  cell.balanced_stable = result.balanced_stable;
  cell.note = result.note;
  return cell;
}

// One cell after another. A search begins with what the previous one found; if both search the same, where that began.
bool run_block(const SweepPlan& plan, std::size_t block, const BlockWorkers& workers) {
  AttractorSearchCache searches;
  std::vector<std::vector<double>> states;
  WarmStartLevels levels;
  std::string subject;
  std::optional<SweepCell> before;
  for (const std::size_t index : plan.cells_of(block)) {
    const Study study = plan.study_of(index);
    const std::string last = std::exchange(subject, attractor_search_subject(study));
    if (before && subject != last) {
      const auto size = static_cast<std::size_t>(study.system().dimension());
      states.clear();
      for (const SweepOutcome& outcome : before->outcomes)
        if (outcome.state.size() == size) states.push_back(outcome.state);
      levels = states.empty() ? WarmStartLevels{} : before->warm_start_levels;
    }
    if (const CellRecord done = workers.known(index); !done.empty()) {
      before = io::cell_from(done);
      continue;
    }
    BasinOptions options = plan.ensemble(workers);
    options.searches = &searches;
    options.warm_start_states = states;
    options.search = states.empty() ? SearchMode::full : SearchMode::warm;
    options.warm_start_levels = &levels;
    Catalogue catalogue;
    WarmStartLevels found;
    const BasinResult result = basin(study, options, &catalogue, &found);
    if (result.partial) return false;
    before = cell_of(result, catalogue);
    before->warm_start_levels = std::move(found);
    workers.deliver(index, io::bytes_of(*before));
  }
  return true;
}

class SweepRun final : public SurveyRun {
 public:
  SweepRun(const SweepPlan& plan, const SweepOptions& options) : SurveyRun(options), plan_(plan), options_(options) {
    result_.study = plan.study();
    result_.axes = plan.axes();
    result_.identity = plan.identity();
    result_.cells.resize(plan.cells());
    result_.half_width = plan.request().half_width;
    result_.transients = plan.transients();
    note_machine(result_, options);
  }
  ~SweepRun() override { dismiss(); }

  SweepResult run() {
    const RunClock clock;
    plan_.check_cells(options_.stop);
    if (!options_.output.empty()) file_ = io::open_sweep_file(options_.output, result_.identity, result_.cells);
    open(sweep_survey(plan_), file_.get());
    std::vector<std::size_t> blocks = blocks_to_do();
    report();
    work(std::move(blocks));
    close();
    label_attractors(result_.axes, result_.cells);
    result_.took(clock.time());
    if (file_) io::finish_sweep_file(*file_, result_);
    return std::move(result_);
  }

 private:
  CellRecord record(std::size_t cell) const override {
    const auto& there = result_.cells[cell];
    return there ? io::bytes_of(*there) : CellRecord{};
  }

  CellRecord take(std::size_t index, const CellRecord& made) override {
    if (result_.cells[index]) return {};
    result_.cells[index] = std::make_shared<SweepCell>(io::cell_from(made));
    return made;
  }

  void kept(std::size_t index) override {
    ++done_;
    if (options_.cell) options_.cell(index, *result_.cells[index]);
    report();
  }

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
};

}  // namespace

Survey sweep_survey(const SweepPlan& plan) {
  return [&plan](std::size_t block, const BlockWorkers& workers) { return run_block(plan, block, workers); };
}

SweepResult sweep(const SweepPlan& plan, const SweepOptions& options) {
  if (options.shards < 1 || options.shard >= options.shards)
    throw InputError("sweep", "shard", fmt::format("{} of {}", options.shard, options.shards),
                     "must be less than the number of shards");
  return long_call(options, [&](const SweepOptions& o) { return SweepRun(plan, o).run(); });
}

}  // namespace equipoise
