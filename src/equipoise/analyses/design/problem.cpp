// Reads and checks a design, and turns points of the cube into studies.
#include "equipoise/analyses/design/problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/design/search.hpp"
#include "equipoise/analyses/design/settings.hpp"
#include "equipoise/analyses/design/variable_reader.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/drives/spin_up_shape.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise {

namespace {

constexpr char must_be_a_bound[] = "must be { below = NUMBER } or { above = NUMBER }";

using study::StudyFile;
using study::TableReader;

constexpr std::int64_t usual_trajectories = 2'000'000, usual_first_look = 1000;

const StudyValue::Table& table_of(const StudyFile& file, const std::string& name) {
  static const StudyValue::Table none;
  const StudyValue* table = file.root.find_path(name);
  if (!table) return none;
  if (!table->table()) throw InputError(file.where(name, table), name, "", fmt::format("must be a table, [{}]", name));
  return *table->table();
}

FigureSource read_figure(const StudyFile& file, const std::string& where, const StudyValue* value,
                         const std::string& name, const Study& study, const std::vector<DesignVariable>& variables) {
  std::string problem;
  if (const auto source = figure_source(name, study, file.root, variables, problem)) return *source;
  throw InputError(file.where("design", value), where, name, problem);
}

// A plain number in the figure's unit, or a quantity of the same dimension.
double read_bound(const DesignEntry& entry, const StudyValue& written, const FigureSource& source, const Study& study) {
  const auto number = entry.number(written);
  if (!number) entry.fail(must_be_a_bound);
  if (number->unit == source.figure.unit) return number->value;
  if (number->unit.empty() || !source.dimension || !study.scales)
    entry.fail(source.figure.unit.empty() ? "must be a plain number"
                                          : fmt::format("must be in {}, or a unit like it", source.figure.unit));
  const study::Measured si = study::measure(*written.string(), {*source.dimension});
  if (!si.problem.empty()) entry.fail(si.problem);
  return si.value / study::scale_of(*source.dimension, *study.scales) / unit_in_study(study, source.dimension);
}

DesignLimit read_limit(const DesignEntry& entry, const FigureSource& source, const Study& study) {
  DesignLimit limit;
  if (!entry.value().table()) entry.fail(must_be_a_bound);
  entry.allow_only({"below", "above"});
  if (const StudyValue* below = entry.value().find("below")) limit.below = read_bound(entry, *below, source, study);
  if (const StudyValue* above = entry.value().find("above")) limit.above = read_bound(entry, *above, source, study);
  if (!limit.below && !limit.above) entry.fail(must_be_a_bound);
  if (limit.below && limit.above && !(*limit.above < *limit.below))
    entry.fail("cannot be met; above must be less than below");
  if (source.figure.share && ((limit.above && *limit.above >= 1.0) || (limit.below && *limit.below <= 0.0)))
    entry.fail("cannot be met by a share; must be between 0 and 1");
  return limit;
}

DesignMethod chosen_method(TableReader& table, std::size_t objectives) {
  DesignMethod method = table.choice("method", design_method_names, std::optional(DesignMethod::automatic));
  if (method == DesignMethod::automatic) method = objectives > 1 ? DesignMethod::nsga2 : DesignMethod::cmaes;
  if (method == DesignMethod::cmaes && objectives > 1)
    table.fail("method", "has one objective; must be nsga2 for several");
  if (method == DesignMethod::nsga2 && objectives == 1)
    table.fail("method", "wants several objectives; must be cmaes for one");
  const bool of_pagmo = method == DesignMethod::cmaes || method == DesignMethod::nsga2;
  if (of_pagmo && !optimisers_built_in())
    table.fail("method", "needs pagmo2 (libpagmo-dev), without which this program was built; must be latin");
  return method;
}

double from_fraction(const DesignVariable& v, double at) {
  if (v.logarithmic) return v.low * std::pow(v.high / v.low, at);
  return v.low + (v.high - v.low) * at;
}

StudyValue value_at(const DesignVariable& v, std::span<const double> at) {
  if (v.spin_up) {
    const SpinUpPoints points = spin_up_at(*v.spin_up, at);
    StudyValue::Array times, speeds;
    for (const double t : points.times) times.push_back(value_of(t, v.spin_up->time_unit));
    for (const double s : points.speeds) speeds.push_back(value_of(s, v.unit));
    StudyValue table{{"profile", "points"}, {"times", StudyValue(times)}, {"speeds", StudyValue(speeds)}};
    if (v.spin_up->law) table.set("law", *v.spin_up->law);
    return table;
  }
  const double fraction = std::clamp(at.front(), 0.0, 1.0);
  const auto place = [&](std::size_t n) {
    return std::min(n - 1, static_cast<std::size_t>(fraction * static_cast<double>(n)));
  };
  if (!v.numbers.empty()) return v.choices[nearest_allowed(v.numbers, from_fraction(v, fraction))];
  if (!v.choices.empty()) return v.choices[place(v.choices.size())];
  if (v.whole)
    return value_of(v.low + static_cast<double>(place(static_cast<std::size_t>(v.high - v.low) + 1)), "", true);
  return value_of(from_fraction(v, fraction), v.unit);
}

// Whether a also sets what b sets.
bool takes_the_place(std::string_view a, std::string_view b) {
  return (a == "speed" && b.starts_with("speed.")) || (a == "release.speed" && b == "release.time");
}

std::size_t coordinates_of(const DesignVariable& v) { return v.spin_up ? coordinates(*v.spin_up) : 1; }

}  // namespace

DesignProblem::DesignProblem(const StudySource& source) : name_(source.name), study_(source.with()) {
  if (!study::parse_study_file(source.toml, source.name, {}).root.find("design")) proposed_ = proposed_design(source);
  const StudyFile file = study::parse_study_file(source.toml + proposed_, source.name, source.overrides);
  for (const auto& [key, value] : table_of(file, "design.vary")) {
    const DesignEntry entry(file, "design.vary", key, value);
    for (const DesignVariable& v : variables_)
      if (takes_the_place(v.key, key) || takes_the_place(key, v.key))
        entry.fail(fmt::format("cannot be varied together with {}, which also sets it", v.key));
    variables_.push_back(read_variable(entry, study_));
  }
  for (const DesignVariable& v : variables_) dimensions_ += coordinates_of(v);
  TableReader table(file, "design");
  table.has("vary");
  table.has("require");
  if (variables_.empty() || dimensions_ > most_design_variables)
    table.fail("vary",
               fmt::format("has {} numbers to choose; must be 1 to {} (a spin-up counts as two per point and one more)",
                           dimensions_, most_design_variables));
  for (const std::string& name : table.texts("objective")) {
    figures_.push_back(
        read_figure(file, "design.objective", file.root.find_path("design.objective"), name, study_, variables_));
    objectives_.push_back(figures_.size() - 1);
    for (std::size_t k = 0; k + 1 < figures_.size(); ++k)
      if (figures_[k].figure.name == name) table.fail("objective", fmt::format("names {} twice", name));
  }
  if (objectives_.empty() || objectives_.size() > most_design_objectives)
    table.fail("objective",
               fmt::format("must be an array of 1 to {} figures, such as [\"balanced\"]", most_design_objectives));
  for (const auto& [key, value] : table_of(file, "design.require")) {
    const DesignEntry entry(file, "design.require", key, value);
    const auto known = std::find_if(figures_.begin(), figures_.end(),
                                    [&wanted = key](const FigureSource& f) { return f.figure.name == wanted; });
    const auto place = static_cast<std::size_t>(known - figures_.begin());
    if (known == figures_.end())
      figures_.push_back(read_figure(file, "design.require", &value, key, study_, variables_));
    limits_.push_back(read_limit(entry, figures_[place], study_));
    limits_.back().figure = place;
  }
  method_ = chosen_method(table, objectives_.size());
  trajectories_ =
      static_cast<std::uint64_t>(table.integer("trajectories", 1000, 1'000'000'000'000, usual_trajectories));
  first_look_ = static_cast<std::uint64_t>(table.integer("starts", 50, 1'000'000, usual_first_look));
  seed_ = static_cast<std::uint64_t>(table.integer("seed", 0, 1'000'000'000, 1));
  if (trajectories_ < 20 * first_look_)
    table.fail("trajectories",
               fmt::format("is too small a budget; must be at least {}, twenty first looks at {} starts",
                           20 * first_look_, first_look_));
  table.finish();
  tree_ = file.root;
  tree_.erase("design");
  tree_.erase("sweep");
  check_candidates();
}

bool DesignProblem::transients() const {
  return std::any_of(figures_.begin(), figures_.end(), [](const FigureSource& f) { return f.transients; });
}

bool DesignProblem::by_outcome() const {
  return std::any_of(figures_.begin(), figures_.end(), [](const FigureSource& f) { return f.by_outcome; });
}

bool DesignProblem::requires_balance() const {
  return std::any_of(limits_.begin(), limits_.end(), [&](const DesignLimit& l) {
    return figures_[l.figure].figure.name == "balanced" && l.above && *l.above > 0.0;
  });
}

std::vector<DesignSetting> DesignProblem::settings_at(std::span<const double> at) const {
  std::vector<DesignSetting> settings;
  for (const DesignVariable& v : variables_) {
    const std::size_t count = coordinates_of(v);
    settings.push_back({v.key, value_at(v, at.first(count))});
    at = at.subspan(count);
  }
  return settings;
}

DesignCandidate DesignProblem::as_it_is() const {
  DesignCandidate candidate;
  candidate.as_it_is = true;
  for (const DesignVariable& v : variables_) {
    const StudyValue* own = v.spin_up ? nullptr : stated_in(tree_, v.key);
    candidate.settings.push_back({v.key, own ? *own : StudyValue(std::string(design_as_given))});
  }
  return candidate;
}

StudyValue DesignProblem::tree_of(const std::vector<DesignSetting>& settings) const {
  StudyValue tree = tree_;
  set_in(tree, settings);
  return tree;
}

Study DesignProblem::study_of(const std::vector<DesignSetting>& settings, std::uint64_t starts,
                              std::uint64_t seed) const {
  StudyValue tree = tree_of(settings);
  set_in(tree, {{"sampling.starts", starts}, {"sampling.seed", seed}, {"sampling.method", "random"}});
  return study_from(tree, name_);
}

// Checks each variable alone at both ends, so that an error names the right one.
void DesignProblem::check_candidates() const {
  check_one({}, "", "");
  for (const DesignVariable& v : variables_) {
    std::vector<double> at(coordinates_of(v), 0.0);
    for (const double end : {0.0, 1.0}) {
      std::fill(at.begin(), at.end(), end);
      const StudyValue value = value_at(v, at);
      check_one({{v.key, value}}, v.key, text_of(value));
    }
    if (v.numbers.empty())
      for (const StudyValue& choice : v.choices) check_one({{v.key, choice}}, v.key, text_of(choice));
  }
}

void DesignProblem::check_one(const std::vector<DesignSetting>& settings, const std::string& key,
                              const std::string& text) const {
  try {
    const Study study = study_of(settings, first_look_, 1);
    reject_if_lacking(study, model::ResultKind::designs);
    check_runnable(study, transients());
  } catch (const InputError& e) {
    if (key.empty()) throw;
    const std::string of = e.key().empty() || e.key() == key ? "" : e.key() + " ";
    throw InputError(name_, "design.vary." + key, text, of + e.problem());
  }
}

// Not prose: searches continue files with the same.
std::string DesignProblem::identity() const {
  BasinFileHeader header = basin_file_header(study_, false, transients());
  header.study = to_toml(tree_);
  std::string text = io::identity_of(header) + "[design]\n";
  for (const DesignVariable& v : variables_) {
    text += fmt::format("vary.{} = {} to {} {}{}{}", v.key, v.low, v.high, v.unit, v.logarithmic ? " log" : "",
                        v.whole ? " whole" : "");
    for (const StudyValue& choice : v.choices) text += " " + text_of(choice);
    if (const auto& s = v.spin_up)
      text += fmt::format(" {} points until {} {}", s->points, s->until, s->time_unit) +
              fmt::format(" slope {} from {} to {}", s->slope.value_or(0.0), s->initial, s->final);
    text += "\n";
  }
  for (const std::size_t k : objectives_) text += fmt::format("objective.{} = {}\n", k, figures_[k].figure.name);
  for (const DesignLimit& l : limits_)
    text +=
        fmt::format("require.{} = {} {}\n", figures_[l.figure].figure.name,
                    l.below ? fmt::format("below {}", *l.below) : "", l.above ? fmt::format("above {}", *l.above) : "");
  text += fmt::format("method = {}\n", design_method_names[static_cast<std::size_t>(method_)]);
  return text + fmt::format("trajectories = {}\nstarts = {}\nseed = {}\n", trajectories_, first_look_, seed_);
}

}  // namespace equipoise
