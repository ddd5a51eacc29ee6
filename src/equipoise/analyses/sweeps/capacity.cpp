// Trials in one cell after another: a scan, then three bisections that share their trials.
#include "equipoise/analyses/sweeps/capacity.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/sweeps/survey_run.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/attractors/motions/catalogue.hpp"
#include "equipoise/classification/balanced_regions/balanced_analysis.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/results/cell_files/cell_file.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"
#include "equipoise/study/toml/overrides.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

constexpr int scan = 8;  // values of the range tried first

// Values have few digits, so that they read back as shown.
double few_digits(double value) { return number_in(fmt::format("{:.6g}", value)); }

// The overrides of a trial.
std::vector<std::string> settings(const SweepPlan& plan, const CapacityOptions& options, double value) {
  const std::string given = fmt::format("{}{}{}", value, options.unit.empty() ? "" : " ", options.unit);
  if (!varies_all_unbalances(plan.source())) return {options.key + "=" + given};
  return unbalances_in_proportion(plan, study::measure(given, {study::Dimension::unbalance}).value);
}

// Of the starts that meet the requirement.
Share asked_share(const BasinResult& result, const std::string& by) {
  if (by == "balanced") return result.attractors.front().share;
  const TransientGroup& all = result.transients->groups.front();
  if (by == "limits") return all.kept().value();
  for (std::size_t k = 0; k < transient_limits.size(); ++k)
    if (by == transient_limits[k].name && all.exceeded[k]) return complement(*all.exceeded[k]);
  throw std::logic_error("no such limit");
}

// One cell's trials, each search beginning with what the nearest earlier one found. Those that are known are taken when
// their turn comes, so that all others come out as if there had been one run.
class Boundary {
 public:
  /// `workers` make the trials that are not known; null: it stops there.
  Boundary(const SweepPlan& plan, const CapacityOptions& options, std::size_t cell, std::vector<CapacityTrial> known,
           const BlockWorkers* workers)
      : plan_(plan), options_(options), cell_(cell), known_(std::move(known)), workers_(workers) {}

  // For a stopped search.
  OpenCapacity open() const {
    OpenCapacity known;
    known.trials = trials_.size();
    for (const auto& [value, made] : trials_) {
      if (made.balanced.least < options_.at_least || made.unstable) break;
      known.low = value;
    }
    for (const auto& [value, made] : trials_)
      if (!known.high && made.most() < options_.at_least) known.high = value;
    return known;
  }

  // Empty if stopped.
  std::optional<CapacityCell> find() {
    // Nothing matters beyond the first value at which the share is certainly too small.
    for (int k = 0; k <= scan; ++k) {
      const CapacityTrial* made = trial(options_.from + (options_.to - options_.from) * k / scan);
      if (!made) return std::nullopt;
      if (made->most() < options_.at_least) break;
    }
    const auto likely = crossing([&](const CapacityTrial& t) { return t.balanced.share < options_.at_least; });
    const auto last_sure = crossing([&](const CapacityTrial& t) { return t.balanced.least < options_.at_least; });
    const auto first_short = crossing([&](const CapacityTrial& t) { return t.most() < options_.at_least; });
    if (stopped_) return std::nullopt;
    CapacityCell result;
    for (const auto& [value, made] : trials_) result.trials.push_back(made);
    result.never = likely.first < options_.from;
    result.always = likely.second > options_.to;
    if (!result.never && !result.always) result.value = 0.5 * (likely.first + likely.second);
    result.low = std::max(last_sure.first, options_.from);
    result.high = std::min(first_short.second, options_.to);
    return result;
  }

 private:
  // Null if stopped.
  const CapacityTrial* trial(double at) {
    const double value = few_digits(at);
    if (const auto made = trials_.find(value); made != trials_.end()) return &made->second;
    for (const CapacityTrial& t : known_)
      if (t.value == value) return &trials_.emplace(value, t).first->second;
    const auto made = stopped_ ? std::nullopt : run(value);
    stopped_ = !made;
    if (!made) return nullptr;
    workers_->deliver(cell_, io::bytes_of(std::vector{*made}));
    return &trials_.emplace(value, *made).first->second;
  }

  std::optional<CapacityTrial> run(double value) const {
    if (!workers_ || is_set(workers_->stop)) return std::nullopt;
    const Study study = plan_.study_of(cell_, settings(plan_, options_, value));
    CapacityTrial made;
    made.value = value;
    // Where no balanced state attracts no start has to be followed; of drawn rotors each has its own.
    if (options_.by == "balanced" && study.uncertain.empty() &&
        !analyse_balanced(study.system(), workers_->stop).stable) {
      made.unstable = true;
      return is_set(workers_->stop) ? std::nullopt : std::optional(made);
    }
    BasinOptions options = plan_.ensemble(*workers_);
    if (const auto* near = nearest(value)) options.warm_start_states = near->states;
    options.search = options.warm_start_states.empty() ? SearchMode::full : SearchMode::warm;
    Catalogue catalogue;
    const BasinResult result = basin(study, options, &catalogue);
    if (result.partial) return std::nullopt;
    made.balanced = asked_share(result, options_.by);
    made.undecided = result.undecided;
    const auto size = static_cast<Eigen::Index>(study.system().dimension());
    for (const Attractor& a : catalogue.attractors())
      if (a.motion.state.size() == size) made.states.emplace_back(a.motion.state.data(), a.motion.state.data() + size);
    return made;
  }

  const CapacityTrial* nearest(double value) const {
    const CapacityTrial* found = nullptr;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [at, made] : trials_)
      if (!made.unstable && std::fabs(at - value) < least) {
        least = std::fabs(at - value);
        found = &made;
      }
    return found;
  }

  // The first value at which it falls short, and the last before it; beyond the range if there is none.
  template <class Short>
  std::pair<double, double> crossing(const Short& falls_short) {
    const double outside = options_.to - options_.from;
    for (;;) {
      if (stopped_) return {};
      double last = options_.from - outside, first = options_.to + outside;
      for (const auto& [value, made] : trials_) {
        if (falls_short(made)) {
          first = value;
          break;
        }
        last = value;
      }
      const bool inside = last >= few_digits(options_.from) && first <= few_digits(options_.to);
      if (!inside || first - last <= options_.precision * outside) return {last, first};
      const double middle = few_digits(0.5 * (last + first));
      if (middle <= last || middle >= first) return {last, first};
      trial(middle);
    }
  }

  const SweepPlan& plan_;
  const CapacityOptions& options_;
  const std::size_t cell_;
  const std::vector<CapacityTrial> known_;
  const BlockWorkers* const workers_;
  std::map<double, CapacityTrial> trials_;  // by value
  bool stopped_ = false;
};

// Everything that determines the results, as text.
std::string capacity_identity(const SweepPlan& plan, const CapacityOptions& o) {
  return plan.identity() + fmt::format("[capacity]\nof = {}\nunit = {}\n", o.key, o.unit.empty() ? "none" : o.unit) +
         fmt::format("from = {}\nto = {}\nat_least = {}\nprecision = {}\n", o.from, o.to, o.at_least, o.precision) +
         (o.by == "balanced" ? "" : fmt::format("by = {}\n", o.by)) +
         (varies_all_unbalances(plan.source()) ? "with = all unbalances\n" : "");
}

class CapacityRun final : public SurveyRun {
 public:
  CapacityRun(const SweepPlan& plan, const CapacityOptions& options)
      : SurveyRun(options), plan_(plan), options_(options), known_(plan.cells()) {
    result_.study = plan.study();
    static_cast<CapacityQuestion&>(result_) = options;
    result_.starts = plan.study().sampling.starts;
    result_.axes = plan.axes();
    result_.cells.resize(plan.cells());
    result_.open.resize(plan.cells());
    const double halvings = std::ceil(std::log2(1.0 / (scan * options.precision)));
    result_.most_trials = plan.cells() * (scan + 1 + 3 * static_cast<std::uint64_t>(std::max(halvings, 0.0)));
    note_machine(result_, options);
  }

  ~CapacityRun() override { dismiss(); }

  CapacityResult run() {
    const RunClock clock;
    check();
    if (!options_.output.empty()) {
      file_ = io::open_capacity_file(options_.output, capacity_identity(plan_, options_), known_);
      for (const auto& trials : known_) result_.resumed_trials += trials.size();
    }
    open(capacity_survey(plan_, options_), file_.get());
    std::vector<std::size_t> missing;
    for (std::size_t cell = 0; cell < plan_.cells(); ++cell)
      if (!find(cell)) missing.push_back(cell);
    work(std::move(missing));
    close();
    for (const std::size_t cell : begun())
      if (!result_.cells[cell]) {
        Boundary boundary(plan_, options_, cell, known_[cell], nullptr);
        boundary.find();
        result_.open[cell] = boundary.open();
      }
    result_.took(clock.time());
    if (file_) io::finish_capacity_file(*file_, result_);
    return std::move(result_);
  }

 private:
  CellRecord record(std::size_t cell) const override {
    return known_[cell].empty() ? CellRecord{} : io::bytes_of(known_[cell]);
  }

  CellRecord take(std::size_t cell, const CellRecord& made) override {
    const auto trials = io::trials_from(made);
    result_.trials += trials.size();
    known_[cell].insert(known_[cell].end(), trials.begin(), trials.end());
    return made;
  }

  void kept(std::size_t cell) override { find(cell); }

  void check() const {
    plan_.check_cells(options_.stop);
    for (std::size_t cell = 0; cell < plan_.cells() && !is_set(options_.stop); ++cell)
      for (const double part : {0.0, 1.0 / scan, 1.0}) {  // between the ends, a key of whole numbers shows itself
        const double value = few_digits(options_.from + (options_.to - options_.from) * part);
        check_decidable_as_read(capacity_study(plan_, options_, cell, value), plan_.transients());
      }
  }

  // Whether its trials say where the boundary lies.
  bool find(std::size_t cell) {
    result_.cells[cell] = Boundary(plan_, options_, cell, known_[cell], nullptr).find();
    if (!result_.cells[cell]) return false;
    ++done_;
    if (options_.progress) options_.progress({done_, plan_.cells(), "cells", std::nullopt});
    return true;
  }

  const SweepPlan& plan_;
  const CapacityOptions& options_;
  CapacityResult result_;
  std::unique_ptr<io::CellFile> file_;
  std::vector<std::vector<CapacityTrial>> known_;
  std::uint64_t done_ = 0;
};

}  // namespace

std::vector<std::string> capacity_goals(const Study& study) {
  std::vector<std::string> goals{"balanced"};
  if (study.limits.any()) goals.emplace_back("limits");
  for (const TransientLimit& l : transient_limits)
    if (study.limits.*l.limit) goals.emplace_back(l.name);
  return goals;
}

std::string capacity_key(const StudySource& source, const std::string& text, const std::string& option) {
  const std::string unbalance = "rotor.unbalance", eccentricity = "rotor.eccentricity";
  const std::string& stated = source.states(unbalance) ? unbalance : eccentricity;
  if (text.empty()) return stated;
  if ((text == unbalance || text == eccentricity) && text != stated)
    throw InputError(option, "", text, fmt::format("the study states {0}; must be {0}, or another key", stated));
  return text;
}

namespace {

// From a fiftieth of what the balls can cancel in the cell with the least to all of it in the cell with the most.
std::optional<CapacityRange> usual_range(const SweepPlan& plan, const std::string& key, const StopFlag* stop) {
  constexpr double least = 0.02, grams_and_millimetres = 1e6, millimetres = 1e3;
  const bool physical = plan.study().physical, unbalance = key == "rotor.unbalance" && physical;
  if (!unbalance && key != "rotor.eccentricity") return std::nullopt;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (std::size_t cell = 0; cell < plan.cells() && !is_set(stop); ++cell) {
    const Study study = plan.checked_study_of(cell);
    const double scale = unbalance  ? study.scales->unbalance() * grams_and_millimetres
                         : physical ? study.scales->length * millimetres
                                    : 1.0;
    const double most = study.parameters.total_mass() * scale;
    low = std::min(low, least * most);
    high = std::max(high, most);
  }
  if (!physical) return CapacityRange{low, high, ""};
  return CapacityRange{few_digits(low), few_digits(high), unbalance ? "g mm" : "mm"};
}

}  // namespace

CapacityRange capacity_range(const SweepPlan& plan, const std::string& key, const std::string& text,
                             const std::string& option, const StopFlag* stop) {
  if (text.empty()) {
    if (const auto usual = usual_range(plan, key, stop)) return *usual;
    throw InputError(option, key, "",
                     "must be given as LOW:HIGH for this key (only rotor.eccentricity, and rotor.unbalance of a study "
                     "in physical units, have a default range)");
  }
  const auto reject = [&] {
    throw InputError(option, key, display_text(text),
                     "must be LOW:HIGH, two numbers or quantities of one unit, the first below the second, e.g. "
                     "0.001:0.1 or \"20 g mm:400 g mm\"");
  };
  const std::vector<std::string> given = parts_of(text, ':');
  if (given.size() != 2) reject();
  const SweepParameter ends = sweep_parameter(key + "=" + given[0] + "," + given[1], option);
  if (ends.values.size() != 2 || !(ends.values[0] < ends.values[1])) reject();
  return {ends.values[0], ends.values[1], ends.unit};
}

Study capacity_study(const SweepPlan& plan, const CapacityOptions& options, std::size_t cell, double value) {
  try {
    return plan.study_of(cell, settings(plan, options, value));
  } catch (const InputError& e) {
    if (e.where() != overrides_name || e.key() != options.key) throw;
    throw InputError(options.of, e.key(), e.value(), e.problem());
  }
}

Survey capacity_survey(const SweepPlan& plan, const CapacityOptions& options) {
  return [&](std::size_t cell, const BlockWorkers& workers) {
    std::vector<CapacityTrial> known;
    if (const CellRecord kept = workers.known(cell); !kept.empty()) known = io::trials_from(kept);
    return Boundary(plan, options, cell, std::move(known), &workers).find().has_value();
  };
}

CapacityResult capacity(const SweepPlan& plan, const CapacityOptions& options) {
  const auto reject = [&](const std::string& what, const std::string& value, const std::string& problem) {
    throw InputError("capacity", what, value, problem);
  };
  if (!(options.from < options.to))
    reject("range", fmt::format("{} to {}", options.from, options.to), "must have its lower end first");
  if (!(options.at_least > 0.0 && options.at_least < 1.0))
    reject("at_least", fmt::format("{}", options.at_least), "must be between 0 and 1");
  if (!(options.precision >= 1e-4 && options.precision <= 0.1))
    reject("precision", fmt::format("{}", options.precision), "must be from 0.0001 to 0.1");
  const std::vector<std::string> goals = capacity_goals(plan.study());
  if (std::find(goals.begin(), goals.end(), options.by) == goals.end())
    reject("by", options.by, fmt::format("must be one of: {}", fmt::join(goals, ", ")));
  return long_call(options, [&](const CapacityOptions& o) { return CapacityRun(plan, o).run(); });
}

}  // namespace equipoise
