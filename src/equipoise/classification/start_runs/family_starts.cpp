// Starts with rotors of their own: drawn ones, given ones of a family, and the motions that one rotor's starts come to.
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/classification/start_runs/batch.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

void change_units(const model::Scales& from, const model::Scales& to, Outcome& outcome, TransientRow* row) {
  if (from.mass == to.mass && from.length == to.length && from.frequency == to.frequency) return;
  const auto change = [&](float& value, study::Dimension d) {
    value = static_cast<float>(value * (study::scale_of(d, from) / study::scale_of(d, to)));
  };
  outcome.time *= from.time() / to.time();
  change(outcome.mean_speed, study::Dimension::speed);
  change(outcome.unbalance, study::Dimension::unbalance);
  change(outcome.radius, study::Dimension::length);
  if (!row) return;
  for (const TransientFigure& f : transient_figures) change(row->*f.value, *f.dimension);
}

bool Session::decide(std::span<const DrawnStart> drawn, Decided& decided) const {
  const int balls = study_.parameters.balls;
  std::vector<std::size_t> places;  // of starts whose values make a study
  std::vector<FamilyStart> starts;
  std::vector<double> phi;
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
    phi.insert(phi.end(), start.phi.begin(), start.phi.begin() + balls);
  }
  Decided those;
  if (!decide(std::move(starts), those)) return false;
  Outcome none;
  none.kind = OutcomeKind::failed;
  decided.phi = std::move(phi);
  decided.outcomes.assign(drawn.size(), none);
  decided.transients.assign(gathers_ ? drawn.size() : 0, transient_row({}, {}, true));
  for (std::size_t k = 0; k < places.size(); ++k) {
    decided.outcomes[places[k]] = those.outcomes[k];
    if (gathers_) decided.transients[places[k]] = those.transients[k];
  }
  decided.unlisted = std::move(those.unlisted);
  for (UnlistedStart& u : decided.unlisted) {
    u.place = places[u.place];
    u.state = {static_cast<double>(drawn[u.place].number)};
  }
  return true;
}

// Results are in the units of the session's study. Coasting rotors are decided one after the other.
bool Session::decide(std::vector<FamilyStart> given, Decided& decided) const {
  decided = {};
  std::vector<std::optional<model::Scales>> scales;
  for (const FamilyStart& start : given) scales.push_back(start.own.study.scales);
  if (system_.coasts()) {
    for (const FamilyStart& start : given)
      if (!decide_coasting(start, decided)) return false;
  } else {
    Batch batch(*this, gathers_);
    if (!batch.begin(std::move(given)) || !batch.finish(decided)) return false;
  }
  for (std::size_t i = 0; i < scales.size(); ++i)
    if (scales[i])
      change_units(*scales[i], *study_.scales, decided.outcomes[i], gathers_ ? &decided.transients[i] : nullptr);
  return true;
}

// Adds a start, decided by a session of its own.
bool Session::decide_coasting(const FamilyStart& start, Decided& decided) const {
  const Session alone(start.own.study, {.stop = stop_}, gathers_);
  RunCatalogue catalogue(alone);
  Decided one;
  if (!alone.decide({&start.own.start, 1}, one)) return false;
  catalogue.settle(one);
  Outcome& outcome = one.outcomes.front();
  if (const Attractor* a = catalogue.find(outcome.attractor); a && outcome.kind == OutcomeKind::attracted) {
    const MotionName name{a->name, a->alias, a->id < first_free_id ? a->id : 0};
    decided.unlisted.push_back({decided.outcomes.size(), {}, a->motion, name});
    decided.unlisted.back().motion->stable = true;
    outcome.attractor = 0;
  }
  decided.outcomes.push_back(outcome);
  decided.transients.insert(decided.transients.end(), one.transients.begin(), one.transients.end());
  return true;
}

bool Session::Batch::begin(std::vector<FamilyStart> given) {
  std::vector<OwnRotorStart> starts;
  for (const FamilyStart& g : given) {
    starts.push_back(g.own);
    cell_.push_back(s_.mesh_.index(g.fractions));
    if (watched_) table_.own.push_back(transient_settings(g.own.study, s_.transients_));
  }
  own_ = std::move(given);
  if (!spin_up_own_rotors(starts, s_.stop_, starts_, watched_table())) return false;
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (follows_open(i)) starts_.rotors[i].end += FamilyCell::further;
  return true;
}

// Takes starts one by one, so that each motion is followed only once.
bool Session::Batch::meet(std::span<const std::size_t> rotor, std::span<MetMotions> met) {
  records_.emplace(starts_.size());
  if (!classify()) return false;
  std::vector<int> late(met.size()), settled(met.size());  // starts of the rotor that the horizon left open
  std::vector<char> restless(met.size());                  // one of the rotor's starts comes to nothing
  for (std::size_t i = 0; i < outcomes_.size(); ++i) {
    const Outcome& outcome = outcomes_[i];
    const std::size_t r = rotor[i];
    const double further = follows_open(i) ? FamilyCell::further : 0.0;
    const bool was_open = outcome.time >= end(i) - further;
    late[r] += was_open;
    const bool open = outcome.kind == OutcomeKind::undecided;
    const bool unlisted = outcome.kind == OutcomeKind::attracted && outcome.attractor == 0;
    if (!unlisted && !(open && !starts_.is_over(i) && !restless[r])) {
      settled[r] += was_open && !open;
      continue;
    }
    const bool comes = meet(i, met[r]);
    if (is_set(s_.stop_)) return false;
    settled[r] += was_open && comes;
    restless[r] |= open && !comes;
  }
  for (std::size_t r = 0; r < met.size(); ++r) met[r].follows_open = 2 * settled[r] >= late[r];
  return true;
}

// Adds the motion that a start ends in, unless it is already there. False if it ends in none, or if stopped.
bool Session::Batch::meet(std::size_t i, MetMotions& met) const {
  const PilotRecord& record = (*records_)[i];
  if (!record.finished_window) return false;
  if (nearest_met(record.features, met.known, s_.system_.balls(), cell(i).search.rule.sameness)) return true;
  const std::optional<UnlistedStart> start = followed(i, outcomes_[i].time, lasting_chaos);
  if (!start || !start->motion || !start->motion->stable) return false;
  if (start->motion->set_valued) return true;  // each ball held by dry friction stays in its own place
  met.motions.push_back(*start->motion);
  met.known.push_back({.features = record.features,
                       .attractor = -static_cast<int>(met.motions.size()),
                       .chaotic = never_repeats(start->motion->kind)});
  return true;
}

}  // namespace equipoise
