// Computes a cell from its study and its neighbour's attractors.
#include "equipoise/analyses/sweeps/sweep_cell.hpp"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"

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

// Where a cell's search begins: where the previous one began, if both search the same.
class Chain {
 public:
  // Call it before every cell, even one that is already known.
  void step(const Study& study, const SweepCell* before) {
    const std::string subject = attractor_search_subject(study);
    if (before && subject != subject_) {
      const auto size = static_cast<std::size_t>(study.system().dimension());
      start_.warm_start_states.clear();
      for (const SweepOutcome& outcome : before->outcomes)
        if (outcome.state.size() == size) start_.warm_start_states.push_back(outcome.state);
      start_.warm_start = !start_.warm_start_states.empty();
      start_.warm_start_levels = start_.warm_start ? before->warm_start_levels : WarmStartLevels{};
    }
    subject_ = subject;
  }

  const CellStart& start() const { return start_; }

 private:
  CellStart start_;
  std::string subject_;
};

}  // namespace

BasinResult cell_ensemble(const SweepPlan& plan, const CellStart& start, const Study& study,
                          const BlockWorkers& workers, AttractorSearchCache* searches, Catalogue& catalogue,
                          WarmStartLevels* found) {
  BasinOptions options;
  options.half_width = plan.request().half_width;
  options.limit_given = plan.request().limit_given;
  options.transients = plan.transients();
  options.without_balls = false;
  options.warm_start_states = start.warm_start_states;
  options.search = start.warm_start ? SearchMode::warm : SearchMode::full;
  options.warm_start_levels = &start.warm_start_levels;
  options.threads = workers.threads;
  if (workers.idle) options.search_threads = workers.threads + workers.idle();
  options.help = workers.help;
  options.stop = workers.stop;
  options.searches = searches;
  options.notes = workers.notes;
  return basin(study, options, &catalogue, found);
}

namespace {

bool run_block(const SweepPlan& plan, std::size_t block, const BlockWorkers& workers) {
  Chain chain;
  AttractorSearchCache searches;
  std::optional<SweepCell> before;
  for (const std::size_t index : plan.cells_of(block)) {
    const Study study = plan.study_of(index);
    chain.step(study, before ? &*before : nullptr);
    if (const CellRecord done = workers.known(index); !done.empty()) {
      before = io::cell_from(done);
      continue;
    }
    Catalogue catalogue;
    WarmStartLevels found;
    const BasinResult result = cell_ensemble(plan, chain.start(), study, workers, &searches, catalogue, &found);
    if (result.partial) return false;
    before = cell_of(result, catalogue);
    before->warm_start_levels = std::move(found);
    workers.deliver(index, io::bytes_of(*before));
  }
  return true;
}

}  // namespace

Survey sweep_survey(const SweepPlan& plan) {
  return [&plan](std::size_t block, const BlockWorkers& workers) { return run_block(plan, block, workers); };
}

}  // namespace equipoise
