// Questions that several parts of a search ask.
#include "equipoise/classification/attractor_search/search.hpp"

#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/classification/attractor_search/own_windows.hpp"
#include "equipoise/simulation/rule/pilot.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/simulation/words/runs.hpp"

namespace equipoise {

namespace {

// A quarter is enough if a neighbour's motions are known. A start costs thirty times as much if two balls touch as if
// they pass each other, and fifty times if many do.
PilotRun::Size pilot_size(const model::System& system, const AttractorSearchSettings& settings) {
  if (settings.few_starts) return {few_scouts, 0, few_scouts};
  const PilotRun::Size whole;
  if (is_dear(system)) return whole.part(settings.brief ? 128 : 16);
  return whole.part(settings.warm_start || system.events().contact ? 4 : 1);
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

Search::Search(const Study& s, const SpinUp& source, const AttractorSearchSettings& asked, const std::string& subject,
               const DrawnSource* drawing)
    : study(s),
      system(s.system()),
      settings(asked),
      drawn(drawing),
      notes(asked.notes, subject),
      stages(words::runs::looking_for_attractors, asked.progress),
      trials{.system = &system,
             .tolerance = source.tolerance(),
             .threads = asked.threads,
             .stop = asked.stop,
             .progress = &stages,
             .notes = &notes},
      pilot(system, source, s.initial, pilot_size(system, asked), drawing) {
  result.catalogue = Catalogue(drawing != nullptr);
}

std::optional<Motion> Search::motion_of_middle(const Eigen::VectorXd& state) {
  return noted(
      "middle's motion", [&] { return motion_from(system, state, motion_patience, settings.stop); },
      [&](std::optional<Motion>& m) { return !m || fits_system(system, *m); });
}

std::vector<PilotRecord> Search::windows_of(const std::vector<const Motion*>& motions,
                                            const std::vector<const OwnRotor*>& own) {
  return noted(
      "windows of motions",
      [&] { return own_windows(system, motions, own, result.rule, pilot_windows, trials.tolerance, settings.stop); },
      [&](const std::vector<PilotRecord>& records) { return records.size() == motions.size(); });
}

std::vector<Fate> Search::fates_of(const std::vector<double>& states, const std::vector<const OwnRotor*>& own,
                                   const ClassificationRule& rule, double longest) {
  return noted(
      "fates by windows",
      [&] { return fates_by_windows(system, states, own, rule, longest, trials.tolerance, settings.stop); },
      [&](const std::vector<Fate>& fates) { return fates.size() * system.dimension() == states.size(); });
}

std::vector<Fate> Search::fates_of(const std::vector<Candidate>& candidates, const ClassificationRule& rule,
                                   double longest) {
  std::vector<double> states;
  std::vector<const OwnRotor*> own;
  for (const Candidate& c : candidates) {
    states.insert(states.end(), c.state.begin(), c.state.end());
    if (c.own) own.push_back(c.own);
  }
  return fates_of(states, own, rule, longest);
}

const KnownFeatures* Search::known_as(const Features& f, const OwnRotor* own) const {
  return nearest_known(f, result.rule.known, balls(), shifts_of(own));
}

bool Search::shows_balance(std::size_t i) const {
  const PilotRecord& record = pilot.records()[i];
  return balance_box && record.finished_window && inside(*balance_box, record.features, balls());
}

}  // namespace equipoise
