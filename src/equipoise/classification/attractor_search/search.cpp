// What several parts of a search need: the rule that it begins with, its key, how motions look and where states go. For
// coasting rotors, energy and short flights replace a search.
#include "equipoise/classification/attractor_search/search.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/classification/trapping_regions/coasting_region.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {

namespace {

// To follow fewer starts of a tilting rotor one by one costs less than to search for what they may come to.
constexpr double worth_a_search = 150.0;

// A quarter is enough if a neighbour's motions are known. A start costs thirty times as much if two balls touch as if
// they pass each other, and fifty times if many do.
PilotRun::Size pilot_size(const model::System& system, const AttractorSearchSettings& settings) {
  if (settings.mode == SearchMode::few) return {few_scouts, 0, few_scouts};
  const PilotRun::Size whole;
  if (is_dear(system)) return whole.part(settings.starts <= starts_of_a_first_look ? 128 : 16);
  return whole.part(settings.mode == SearchMode::warm || system.events().contact ? 4 : 1);
}

// More groups would be the debris of a motion that does not become steady. Most of few starts end in a few motions;
// with events each takes seconds. A part of a family that was halved has the motions of the whole, and its halves
// search again; rare motions are left to their starts.
std::size_t groups_followed(const model::System& system, SearchMode mode, bool drawn) {
  if (mode == SearchMode::few) return system.smooth() ? 6 : 2;
  return drawn && mode == SearchMode::warm ? 8 : 24;
}

// Follows states by a rule, from psi = 0, as on a stroboscopic section, for `longest` times its first long window.
// False if stopped.
bool follow_windows(const Search& s, std::vector<double> states, const std::vector<const OwnRotor*>& own,
                    const ClassificationRule& rule, double longest, std::vector<Outcome>& outcomes,
                    std::vector<PilotRecord>* records) {
  BatchTask task = batch_task(s.system);
  task.end = longest * rule.first_long_window + rule.window;  // windows end with a step, a little late
  task.tolerance = s.trials.tolerance;
  task.stop = s.settings.stop;
  std::vector<OwnRotor> rotors;
  for (const OwnRotor* given : own) {
    rotors.push_back(*given);
    rotors.back().segment = own_rotor(given->system).segment;
    rotors.back().end = task.end;
  }
  const std::vector<const OwnRotor*> pointers = pointers_to(rotors);
  task.take(states, pointers, {});
  return outcomes.empty() || classify_batch(task, rule, outcomes, records);
}

// Makes half a window hold whole periods of the section, so that motions in step with the rotor look the same in all.
double whole_sections(double window, double section_period) {
  return 2.0 * section_period * std::ceil(0.5 * window / section_period - 1e-9);
}

}  // namespace

bool is_dear(const model::System& system) {
  return system.events().contact && system.balls() > 2 && !system.autonomous();
}

Motion measured_motion() {
  Motion motion;
  motion.kind = MotionKind::measured;
  motion.stable = true;
  return motion;
}

SearchPlan::SearchPlan(const model::System& system, const AttractorSearchSettings& settings, bool drawn)
    : balance_alone(drawn && system.tilts() && settings.starts < worth_a_search),
      pilot(pilot_size(system, settings)),
      groups(groups_followed(system, settings.mode, drawn)),
      // Where rotors differ, chaos that lasts this long counts as lasting.
      patience(drawn ? std::min(followed_for(system, settings.mode), lasting_chaos)
                     : followed_for(system, settings.mode)) {}

Search::Search(const Study& s, const SpinUp& source, const AttractorSearchSettings& asked, const std::string& subject,
               const DrawnSource* drawing)
    : study(s),
      system(s.system()),
      settings(asked),
      drawn(drawing),
      notes(asked.notes, subject),
      plan(system, asked, drawing != nullptr),
      stages("looking for attractors", asked.progress),
      trials{.system = &system,
             .tolerance = source.tolerance(),
             .threads = asked.threads,
             .stop = asked.stop,
             .progress = &stages,
             .notes = &notes},
      pilot(system, source, s.initial, plan.pilot, drawing) {
  result.catalogue = Catalogue(drawing != nullptr);
}

std::optional<Motion> Search::motion_of_middle(const Eigen::VectorXd& state) {
  return noted(
      "middle's motion", [&] { return motion_from(system, state, motion_patience, settings.stop); },
      [&](std::optional<Motion>& m) { return !m || fits_system(system, *m); });
}

std::vector<PilotRecord> Search::windows_of(const std::vector<const Motion*>& motions,
                                            const std::vector<const OwnRotor*>& own) {
  const auto follow_all = [&] {
    std::vector<double> states;
    for (const Motion* motion : motions) states.insert(states.end(), motion->state.begin(), motion->state.end());
    ClassificationRule windows_only;
    windows_only.balls = result.rule.balls;
    windows_only.interchangeable = result.rule.interchangeable;
    windows_only.blind = true;
    windows_only.sag = result.rule.sag;
    windows_only.window = result.rule.window;
    windows_only.first_long_window = result.rule.first_long_window;
    windows_only.sameness = result.rule.sameness;
    std::vector<Outcome> outcomes(motions.size());
    std::vector<PilotRecord> records(motions.size());
    if (!follow_windows(*this, std::move(states), own, windows_only, pilot_windows, outcomes, &records))
      records.assign(motions.size(), {});
    return records;
  };
  return noted("windows of motions", follow_all,
               [&](const std::vector<PilotRecord>& records) { return records.size() == motions.size(); });
}

std::vector<Outcome> Search::outcomes_of(const std::vector<double>& states, const std::vector<const OwnRotor*>& own,
                                         ClassificationRule rule, double longest) {
  rule.blind = false;
  const std::size_t count = states.size() / static_cast<std::size_t>(system.dimension());
  const auto follow_all = [&] {
    std::vector<Outcome> outcomes(count);
    if (!follow_windows(*this, states, own, rule, longest, outcomes, nullptr)) outcomes.assign(count, {});
    return outcomes;
  };
  return noted("outcomes by windows", follow_all, [&](const std::vector<Outcome>& outcomes) {
    return outcomes.size() * system.dimension() == states.size();
  });
}

std::vector<Outcome> Search::outcomes_of(const std::vector<Candidate>& candidates, const ClassificationRule& rule,
                                         double longest) {
  std::vector<double> states;
  std::vector<const OwnRotor*> own;
  for (const Candidate& c : candidates) {
    states.insert(states.end(), c.state.begin(), c.state.end());
    if (c.own) own.push_back(c.own);
  }
  return outcomes_of(states, own, rule, longest);
}

const KnownFeatures* Search::known_as(const Features& f, const OwnRotor* own) const {
  return nearest_known(f, result.rule.known, balls(), shifts_of(own));
}

const KnownFeatures* Search::looks_like(const Features& f, const OwnRotor* own, double tolerance, int attractor) const {
  for (const KnownFeatures& k : result.rule.known)
    if ((attractor == 0 || k.attractor == attractor) &&
        same_motion(k.features, brought_back(f, k.trend, shifts_of(own), balls()), balls(), tolerance))
      return &k;
  return nullptr;
}

bool Search::shows_balance(std::size_t i) const {
  const PilotRecord& record = pilot.records()[i];
  return balance_box && record.finished_window && inside(*balance_box, record.features, balls());
}

ClassificationRule first_rule(const Study& study, const BalancedAnalysis& balanced, const model::System& system) {
  ClassificationRule rule;
  rule.balls = study.parameters.balls;
  rule.interchangeable = study.parameters.equal_balls();
  rule.balanced = balanced.regions;
  // Slow rotors move slowly. A window holds several revolutions of every motion met between 1.4 and 6.5 critical
  // speeds.
  const double pace = system.coasts() ? study.stall_speed() : std::fabs(system.pace());
  rule.window = std::max(16.0, 32.0 / std::max(pace, 0.1));
  rule.sag = model::static_sag(study.parameters);
  if (system.section() == model::Section::stroboscopic)
    rule.window = whole_sections(rule.window, system.section_period());
  if (system.runs_away(rule.fastest)) rule.fastest = model::out_of_reach;
  rule.first_long_window = std::max(100.0, 6.0 * rule.window);
  if (balanced.slowest_rate < 0.0) {
    // Long enough that a slow way to balance shrinks visibly from one window to the next.
    rule.first_long_window = std::max(rule.first_long_window, 1.0 / -balanced.slowest_rate);
    rule.first_long_window = std::min(rule.first_long_window, *study.numerics.horizon / 8.0);
    rule.sameness = std::min(rule.sameness, 0.2 * -balanced.slowest_rate * rule.first_long_window);
  }
  return rule;
}

double followed_for(const model::System& system, SearchMode mode) {
  if (mode == SearchMode::few && !system.smooth()) return 0.125 * motion_patience;
  return is_dear(system) ? 0.25 * motion_patience : motion_patience;
}

std::string attractor_search_subject(const Study& study) { return to_toml(at_final_speed(study)); }

std::string search_key(const std::string& subject, const AttractorSearchSettings& settings) {
  std::string key = fmt::format("{}\n{}\n{}", subject, settings.warm_start_states, settings.mode == SearchMode::warm);
  if (settings.starts <= starts_of_a_first_look) key += "\nfirst look";
  if (settings.mode == SearchMode::few) key += "\nfew starts";
  for (const WarmStartLevel& h : settings.warm_start_levels.levels) key += fmt::format("\n{} {}", h.attractor, h.level);
  for (const ModeWeight& w : settings.warm_start_levels.weights) key += fmt::format("\n{} {} {}", w.re, w.im, w.weight);
  return key;
}

std::string search_key(const FamilyBox& part, const AttractorSearchSettings& settings) {
  return search_key(fmt::format("{}\n{} to {}", settings.family, part.low, part.high), settings);
}

AttractorSearch discover_coasting(const Study& study, const StopFlag* stop) {
  const model::System system = study.system();
  AttractorSearch result;
  result.balanced = analyse_balanced(system, stop);
  std::string& note = result.balanced.note;
  if (note.empty()) note = "no torque acts in the end, and the speed that the rotor then keeps is not known beforehand";
  ClassificationRule& rule = result.rule = first_rule(study, result.balanced, system);
  const double horizon = *study.numerics.horizon;
  // Windows must be long enough to show slow losses of speed.
  rule.first_long_window = std::max(rule.first_long_window, horizon / 16.0);
  rule.at_horizon = study.numerics.decide == ClassificationMode::horizon;
  const auto region = std::make_shared<const CoastingRegion>(system, study.stall_speed(), horizon);
  result.coasting = region;
  Motion balanced = measured_motion();  // as is the stalled rotor: each start ends in a motion of its own
  balanced.set_valued = system.events().stick;
  result.catalogue.add({balanced_id, balanced.set_valued ? "balanced, stuck" : "balanced", "", balanced, {}});
  const int stalled = result.catalogue.add({"stalled", "", 0}, measured_motion());
  rule.section.regions = regions_by([region, stalled, stop](const double* state, double, const OwnRotor*) {
    return region->stalls(state) ? Caught{stalled} : region->balances(state, stop);
  });
  return result;
}

}  // namespace equipoise
