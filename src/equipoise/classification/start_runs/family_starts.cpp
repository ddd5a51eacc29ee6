// Starts with rotors of their own: drawn ones, given ones of a family, and the motions that one rotor's starts come to.
#include <utility>
#include <vector>

#include "equipoise/classification/start_runs/start_runner.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

void change_units(const model::Scales& from, const model::Scales& to, Fate& fate, TransientRow* row) {
  if (from.mass == to.mass && from.length == to.length && from.frequency == to.frequency) return;
  const auto change = [&](float& value, study::Dimension d) {
    value = static_cast<float>(value * (study::scale_of(d, from) / study::scale_of(d, to)));
  };
  fate.time *= from.time() / to.time();
  change(fate.mean_speed, study::Dimension::speed);
  change(fate.unbalance, study::Dimension::unbalance);
  change(fate.radius, study::Dimension::length);
  if (!row) return;
  for (const TransientFigure& f : transient_figures) change(row->*f.value, *f.dimension);
}

bool StartRunner::run_drawn(std::span<const DrawnStart> drawn, Decided& decided, bool watched) const {
  const int balls = study_.parameters.balls;
  std::vector<std::size_t> places;  // of starts whose values make a study
  std::vector<FamilyStart> starts;
  decided.phi.clear();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    InitialState start;
    try {
      Study study = family_->at(family_->values_at(drawn[i].fractions));
      start = start_of(study, sampler_, study_.sampling.seed, drawn[i].number);
      const InitialState apart = parted(study.parameters, start);
      starts.push_back({{std::move(study), apart}, drawn[i].fractions});
      places.push_back(i);
    } catch (const InputError&) {  // values beyond the ends that check_drawable() tried
      start = start_of(study_, sampler_, study_.sampling.seed, drawn[i].number);
    }
    decided.phi.insert(decided.phi.end(), start.phi.begin(), start.phi.begin() + balls);
  }
  Decided those;
  if (!run_family(std::move(starts), those, watched)) return false;
  Fate none;
  none.outcome = Outcome::failed;
  decided.fates.assign(drawn.size(), none);
  decided.transients.assign(watched ? drawn.size() : 0, transient_row({}, {}, true));
  for (std::size_t k = 0; k < places.size(); ++k) {
    decided.fates[places[k]] = those.fates[k];
    if (watched) decided.transients[places[k]] = those.transients[k];
  }
  decided.unlisted = std::move(those.unlisted);
  for (UnlistedStart& u : decided.unlisted) {
    u.place = places[u.place];
    u.state = {static_cast<double>(drawn[u.place].number)};
  }
  return true;
}

// Decides starts with the family's rotors; results are in the units of the study's medians.
bool StartRunner::run_family(std::vector<FamilyStart> given, Decided& decided, bool watched) const {
  if (system_.coasts()) return run_coasting(given, decided, watched);
  Batch batch(*this, watched);
  if (!begin_family(std::move(given), batch) || !finish(batch, decided)) return false;
  for (std::size_t i = 0; i < decided.fates.size(); ++i)
    if (const auto& scales = batch.own[i].own.study.scales)
      change_units(*scales, *study_.scales, decided.fates[i], watched ? &decided.transients[i] : nullptr);
  return true;
}

bool StartRunner::begin_family(std::vector<FamilyStart> given, Batch& batch) const {
  std::vector<OwnRotorStart> starts;
  for (const FamilyStart& g : given) {
    starts.push_back(g.own);
    batch.cell.push_back(mesh_.index(g.fractions));
    if (batch.watched) batch.table.own.push_back(transient_settings(g.own.study, transients_));
  }
  batch.own = std::move(given);
  if (!spin_up_own_rotors(starts, stop_, batch.starts, batch.watched_table())) return false;
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (follows_open(batch, i)) batch.starts.rotors[i].end += FamilyCell::further;
  return true;
}

bool StartRunner::follows_open(const Batch& batch, std::size_t i) const {
  const MetMotions* met = batch.own[i].met;
  return mesh_.cells[batch.cell[i]].follows_open && (!met || met->follows_open);
}

// Takes starts one by one, so that each motion is followed only once.
bool StartRunner::meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor,
                       std::span<MetMotions> met) const {
  Batch batch(*this, false);
  batch.records.emplace(given.size());
  if (!begin_family(std::move(given), batch) || !decide(batch)) return false;
  std::vector<int> late(met.size()), settled(met.size());  // starts of the rotor that the horizon left open
  std::vector<char> restless(met.size());                  // one of the rotor's starts comes to nothing
  for (std::size_t i = 0; i < batch.fates.size(); ++i) {
    const Fate& fate = batch.fates[i];
    const std::size_t r = rotor[i];
    const double further = follows_open(batch, i) ? FamilyCell::further : 0.0;
    const bool was_open = fate.time >= batch.end(i) - further;
    late[r] += was_open;
    const bool open = fate.outcome == Outcome::undecided;
    const bool unlisted = fate.outcome == Outcome::attracted && fate.attractor == 0;
    if (!unlisted && !(open && !batch.starts.is_over(i) && !restless[r])) {
      settled[r] += was_open && !open;
      continue;
    }
    const bool comes = meet(batch, i, met[r]);
    if (is_set(stop_)) return false;
    settled[r] += was_open && comes;
    restless[r] |= open && !comes;
  }
  for (std::size_t r = 0; r < met.size(); ++r) met[r].follows_open = 2 * settled[r] >= late[r];
  return true;
}

// Adds the motion that a start comes to, unless it is already there. False if it comes to none, or if stopped.
bool StartRunner::meet(const Batch& batch, std::size_t i, MetMotions& met) const {
  const PilotRecord& record = (*batch.records)[i];
  if (!record.finished_window) return false;
  const double sameness = mesh_.cells[batch.cell[i]].search.rule.sameness;
  if (nearest_met(record.features, met.known, study_.parameters.balls, sameness)) return true;
  const std::optional<UnlistedStart> start = unlisted_start(batch, i, batch.fates[i].time, lasting_chaos);
  if (!start || !start->motion || !start->motion->stable) return false;
  if (start->motion->set_valued) return true;  // each ball held by dry friction stays in its own place
  met.motions.push_back(*start->motion);
  met.known.push_back({.features = record.features,
                       .attractor = -static_cast<int>(met.motions.size()),
                       .chaotic = never_repeats(start->motion->kind)});
  return true;
}

// One rotor after the other.
bool StartRunner::run_coasting(std::span<const FamilyStart> given, Decided& decided, bool watched) const {
  decided = {};
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Study& study = given[i].own.study;
    StartRunner alone(study, {.stop = stop_}, watched);
    Decided one;
    if (!alone.run_from({&given[i].own.start, 1}, one)) return false;
    alone.settle(one);
    Fate& fate = decided.fates.emplace_back(one.fates.front());
    if (const Attractor* a = alone.catalogue().find(fate.attractor); a && fate.outcome == Outcome::attracted) {
      decided.unlisted.push_back({i, {}, a->motion, {a->name, a->alias, a->id < first_free_id ? a->id : 0}});
      decided.unlisted.back().motion->stable = true;
      fate.attractor = 0;
    }
    if (watched) decided.transients.push_back(one.transients.front());
    if (study.scales) change_units(*study.scales, *study_.scales, fate, watched ? &decided.transients.back() : nullptr);
  }
  return true;
}

}  // namespace equipoise
