// Computes cells from their studies and their neighbours' attractors; takes them in, keeps and reports them; reads and
// merges files of them.
#include "equipoise/analyses/sweeps/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/sweeps/survey_run.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/results/cell_files/sweep_cells.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/types/warm_start_levels.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

// Largest difference between two motions that count as the same at neighbouring parameters.
constexpr double farthest = 1.0 / 3.0;

double relative(double a, double b) {
  const double size = std::max(std::fabs(a), std::fabs(b));
  return size > 0.0 ? std::fabs(a - b) / size : 0.0;
}

// Balls may have changed places.
double drift_difference(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double difference = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    difference = std::max(difference, relative(a[i], b[i]));
  return difference;
}

double distance(const SweepOutcome& a, const SweepOutcome& b) {
  if (a.kind != b.kind || without_number(a.name) != without_number(b.name))
    return std::numeric_limits<double>::infinity();
  if (!a.r_max || !b.r_max) return 0.0;  // matched by name alone
  return std::max({relative(*a.r_mean, *b.r_mean), relative(*a.r_max, *b.r_max), drift_difference(a.drift, b.drift)});
}

class Labels {
 public:
  Labels(const std::vector<SweepAxis>& axes, SweepCells& cells) : axes_(axes), cells_(cells) {}

  void label(std::size_t index) {
    SweepCell& cell = *cells_[index];
    std::vector<SweepOutcome*> open;
    std::set<int> used;
    for (SweepOutcome& outcome : cell.outcomes)
      if (outcome.own_id < first_free_id)
        names_.try_emplace(outcome.id = outcome.own_id, outcome.name);
      else
        open.push_back(&outcome);
    match(open, neighbours(index), used);
    for (SweepOutcome* outcome : open) outcome->id = next(outcome->name);
    for (SweepOutcome& outcome : cell.outcomes) outcome.name = names_.at(outcome.id);
  }

 private:
  std::vector<const SweepCell*> neighbours(std::size_t index) const {
    std::vector<const SweepCell*> found;
    const std::vector<std::size_t> place = place_on(axes_, index);
    std::size_t stride = 1;
    for (std::size_t a = axes_.size(); a-- > 0; stride *= axes_[a].size())
      if (place[a] > 0 && cells_[index - stride]) found.push_back(&*cells_[index - stride]);
    return found;
  }

  // The nearest pairs first; whatever finds a partner leaves `open`.
  void match(std::vector<SweepOutcome*>& open, const std::vector<const SweepCell*>& neighbours, std::set<int>& used) {
    for (;;) {
      double least = farthest;
      auto chosen = open.end();
      int id = 0;
      for (auto o = open.begin(); o != open.end(); ++o)
        for (const SweepCell* cell : neighbours)
          for (const SweepOutcome& other : cell->outcomes) {
            if (other.own_id < first_free_id || used.count(other.id)) continue;
            const double off = distance(**o, other);
            if (off >= least) continue;
            least = off;
            chosen = o;
            id = other.id;
          }
      if (chosen == open.end()) return;
      (*chosen)->id = id;
      used.insert(id);
      open.erase(chosen);
    }
  }

  int next(const std::string& name) {
    const int id = std::max(first_free_id, names_.empty() ? 0 : names_.rbegin()->first + 1);
    const std::string plain = without_number(name);
    std::string unique = plain;
    const auto taken = [&](const std::string& text) {
      return std::any_of(names_.begin(), names_.end(), [&](const auto& entry) { return entry.second == text; });
    };
    for (int number = 2; taken(unique); ++number) unique = fmt::format("{} ({})", plain, number);
    names_[id] = unique;
    return id;
  }

  const std::vector<SweepAxis>& axes_;
  SweepCells& cells_;
  std::map<int, std::string> names_;  // by identifier
};

}  // namespace

void label_attractors(const std::vector<SweepAxis>& axes, SweepCells& cells) {
  Labels labels(axes, cells);
  for (std::size_t index = 0; index < cells.size(); ++index)
    if (cells[index]) labels.label(index);
}

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

namespace {

constexpr char no_sweep[] = "does not say which sweep it is of";

// The inverse of SweepPlan::identity(), as far as results need it.
SweepResult asked_for(const std::string& identity, const std::string& path) {
  SweepResult result;
  const io::IdentityLines lines(identity);
  const std::vector<std::string> over = lines.over();
  const std::size_t axes = std::strtoul(lines.value("sweep.axes").c_str(), nullptr, 10);
  if (over.empty() || axes == 0) throw InputError(path, "", "", no_sweep);
  result.half_width = number_in(lines.value("sweep.half_width"));
  result.transients = lines.value("transients") != "none";
  result.study = parse_kept_study(lines.study, path);
  result.axes = sweep_axes(over, axes < over.size(), path);
  std::size_t cells = 1;
  for (const SweepAxis& axis : result.axes) cells *= axis.size();
  if (cells != lines.cells()) throw InputError(path, "", "", no_sweep);
  result.identity = identity;
  result.cells.resize(cells);
  result.cpu_target = cpu_target();
  return result;
}

}  // namespace

SweepResult stored_sweep(const std::string& path, const RunOptions& options) {
  const StoredSweep stored = read_sweep(path);
  give_notice(options, stored.loss);
  SweepResult result = asked_for(stored.identity, path);
  for (const auto& [k, cell] : stored.cells) result.cells[k] = cell;
  for (const auto& cell : result.cells) result.resumed_cells += cell != nullptr;
  label_attractors(result.axes, result.cells);
  return result;
}

SweepResult merge_sweeps(const std::vector<std::string>& files, const std::string& output, const RunOptions& options) {
  if (files.empty()) throw InputError("merge", "", "", "must be at least one file of a sweep");
  const std::string identity = read_sweep(files.front()).identity;
  SweepResult result = asked_for(identity, files.front());
  const auto into = io::open_sweep_file(output, identity, result.cells);
  give_notice(options, into->loss());
  for (const std::string& path : files) {
    const StoredSweep part = read_sweep(path);
    give_notice(options, part.loss);
    if (const std::string how = io::difference(part.identity, identity); !how.empty())
      throw InputError(path, "", "", fmt::format("is of another sweep than {}: {}", files.front(), how));
    for (const auto& [k, cell] : part.cells) {
      if (result.cells[k]) continue;
      into->append(k, io::bytes_of(*cell));
      result.cells[k] = cell;
    }
  }
  label_attractors(result.axes, result.cells);
  io::finish_sweep_file(*into, result);
  return result;
}

}  // namespace equipoise
