// Decides a batch of starts: first by the rule, then each unlisted one by following it to its motion.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/attractors/motions/motion_figures.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/attractor_search/search.hpp"
#include "equipoise/classification/start_runs/start_runner.hpp"
#include "equipoise/classification/start_runs/undecided.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/rule/window_features.hpp"

namespace equipoise {

namespace {

// Patience for a trajectory followed far beyond the horizon: it rests or repeats itself by now, or never will.
constexpr double a_look = 1000.0;

float unbalance_of(const model::System& system, const double* state) {
  return static_cast<float>(std::abs(model::unbalance(system.parameters(), state + model::index::phi(0))));
}

}  // namespace

// Applies the rule to all starts that are not over; the others keep their fates.
bool StartRunner::decide(Batch& batch) const {
  batch.fates = batch.starts.fates;
  if (few_starts_) batch.records.emplace(batch.starts.size());
  std::vector<std::vector<std::size_t>> cells(family_ ? mesh_.cells.size() : 1);
  for (std::size_t i = 0; i < batch.starts.size(); ++i) {
    if (batch.starts.is_over(i) || !(batch.starts.begin(i, source_->settled()) < batch.end(i))) continue;
    cells[family_ ? batch.cell[i] : 0].push_back(i);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].empty()) continue;
    const ClassificationRule& rule = family_ ? mesh_.cells[c].search.rule : search_.rule;
    if (!classify_some(batch, cells[c], rule)) return false;
    for (const std::size_t i : cells[c])
      if (family_) batch.fates[i].attractor = static_cast<short>(mesh_.cells[c].id(batch.fates[i].attractor));
  }
  return true;
}

bool StartRunner::classify_some(Batch& batch, const std::vector<std::size_t>& places,
                                const ClassificationRule& rule) const {
  const std::size_t size = system_.dimension();
  SpunUp& starts = batch.starts;
  BatchTask task = source_->last_task();
  task.end = source_->settled() + *study_.numerics.horizon;
  std::vector<double> states, begins;
  std::vector<const OwnRotor*> own;
  TransientTable rows;
  if (batch.watched) rows = batch.table.part(places);
  for (const std::size_t i : places) {
    states.insert(states.end(), &starts.states[i * size], &starts.states[i * size] + size);
    begins.push_back(starts.begin(i, source_->settled()));
    if (!family_) continue;
    const FamilyCell& cell = mesh_.cells[batch.cell[i]];
    starts.rotors[i].coordinates = family_->coordinates(cell.box, batch.own[i].fractions);
    cell.search.place(starts.rotors[i]);
    if (const MetMotions* met = batch.own[i].met) starts.rotors[i].met = &met->known;
    own.push_back(&starts.rotors[i]);
  }
  task.take(states, own, begins);
  if (batch.watched) task.transients = &rows;
  std::vector<Fate> decided(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) decided[k].met = starts.fates[places[k]].met;
  std::vector<PilotRecord> records(batch.records ? places.size() : 0);
  if (!classify_batch(task, rule, decided, batch.records ? &records : nullptr)) return false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t i = places[k];
    batch.fates[i] = decided[k];
    if (batch.records) (*batch.records)[i] = records[k];
    std::copy_n(&states[k * size], size, &starts.states[i * size]);
  }
  if (batch.watched) batch.table.put_back(places, rows);
  return true;
}

// Decides starts and says what each came to.
bool StartRunner::finish(Batch& batch, Decided& decided) const {
  if (!decide(batch) || !note_last_speeds(batch) || !note_radii(batch)) return false;
  const std::size_t count = batch.starts.size();
  decided.fates = std::move(batch.fates);
  decided.unlisted.clear();
  decided.transients.assign(batch.watched ? count : 0, TransientRow{});
  for (std::size_t i = 0; i < count; ++i) {
    Fate& fate = decided.fates[i];
    const model::System& system = batch.system(i);
    const bool left = fate.outcome == Outcome::undecided && !batch.starts.is_over(i) && fate.time >= batch.end(i);
    // No list need hold for a rotor of the start's own, so it is followed beyond the horizon if that pays.
    const bool open = left && family_ && follows_open(batch, i);
    if (open) fate.outcome = Outcome::attracted;
    const bool attracted = fate.outcome == Outcome::attracted;
    std::optional<MotionFigures> end;
    if (left && !open && is_in_chaos(system, when_recognised(batch, i, fate.time), fate.time)) {
      decided.unlisted.push_back(in_chaos(batch, i, fate.time));
      fate.outcome = Outcome::attracted;
      fate.by = DecidedBy::horizon;
    } else if (attracted && fate.attractor <= 0) {
      // A watched trajectory has gone on since it was decided.
      const double now = batch.watched ? batch.table.rows[i].end : fate.time;
      const double patience = !family_ ? followed_for(system_, few_starts_) : open ? a_look : lasting_chaos;
      std::optional<UnlistedStart> start = fate.attractor < 0 ? met_again(batch, i, fate)
                                           : few_starts_      ? unlisted_of_few(batch, i, now)
                                                              : unlisted_start(batch, i, now, patience);
      if (!start) return false;
      // Few starts are not all followed.
      if (!start->motion && !few_starts_ && is_in_chaos(system, start->state, now + patience)) {
        start = in_chaos(batch, i, now);
        fate.time = std::max(fate.time, now + patience);
      }
      decided.unlisted.push_back(*std::move(start));
      fate.attractor = 0;
      const auto& motion = decided.unlisted.back().motion;
      const bool known = motion && motion->kind != MotionKind::measured;
      fate.by = motion && !known ? DecidedBy::windows : DecidedBy::followed;
      if (known && !system.prescribed()) fate.mean_speed = static_cast<float>(motion->speed);
      if (motion && motion->set_valued) fate.unbalance = unbalance_of(system, motion->state.data());
      if (batch.watched && known && motion->stable)
        end = motion_figures(system.parameters(), *motion, batch.table.settings_of(i).shaft);
    } else if (attracted) {
      if (system_.coasts()) fate.by = DecidedBy::followed;
      fate.mean_speed = static_cast<float>(mean_speed(batch, i, fate));
      end = batch.table.end_of(fate.attractor).figures;
    }
    // Balls held by dry friction leave a different unbalance after each start.
    const Attractor* listed = attracted && fate.attractor > 0 ? catalogue_.find(fate.attractor) : nullptr;
    if (listed && listed->motion.set_valued) fate.unbalance = unbalance_of(system, batch.state(i));
    // Whatever its motion is called, the motor did not bring the rotor up to speed.
    if (attracted && !system.prescribed() && std::fabs(fate.mean_speed) < batch.study(i).stall_speed())
      fate.outcome = Outcome::stalled;
    if (!batch.watched) continue;
    const bool lost = fate.outcome == Outcome::diverged || fate.outcome == Outcome::failed;
    TransientSettings settings = batch.table.settings_of(i);
    // A motor releases the balls of each start at a different time.
    if (!batch.starts.released.empty()) settings.release = batch.starts.released[i];
    decided.transients[i] = transient_row(settings, batch.table.rows[i], lost, end);
  }
  return true;
}

// Of a trajectory that came to nothing until `followed`. Exponents are those of the linearised equations, which
// meetings of balls break off.
bool StartRunner::is_in_chaos(const model::System& system, const std::vector<double>& state, double followed) const {
  if (!system.smooth() || system.coasts() || followed - source_->settled() < lasting_chaos) return false;
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  return look_at_undecided(system, z).what == Restlessness::chaotic;
}

UnlistedStart StartRunner::in_chaos(const Batch& batch, std::size_t i, double now) const {
  return {i, when_recognised(batch, i, now), measured_motion(), {long_lived_chaos, "", 0}};
}

// The mean speed of a driven rotor is its attractor's, for a trapping region may catch it before it has turned for
// long. A coasting rotor keeps the speed that it has in balance; any other end is at rest.
double StartRunner::mean_speed(const Batch& batch, std::size_t i, const Fate& fate) const {
  if (system_.prescribed()) return fate.mean_speed;
  if (system_.coasts()) return fate.attractor == balanced_id ? batch.state(i)[system_.layout().speed] : 0.0;
  if (family_ && fate.attractor == balanced_id) return model::balanced_speed(batch.system(i)).value_or(fate.mean_speed);
  // A start decided by windows has long turned at its speed. One caught by a trapping region may still be speeding up.
  const bool seen = fate.by == DecidedBy::windows || fate.by == DecidedBy::horizon;
  const Attractor* a = family_ && seen && !std::isnan(fate.mean_speed) ? nullptr : catalogue_.find(fate.attractor);
  return a && a->motion.kind != MotionKind::measured ? a->motion.speed : fate.mean_speed;
}

// `patience` applies to a start with a rotor of its own.
std::optional<UnlistedStart> StartRunner::unlisted_start(const Batch& batch, std::size_t i, double now,
                                                         double patience) const {
  const std::vector<double> state = when_recognised(batch, i, now);
  std::optional<UnlistedStart> start;
  if (!family_) {
    start = follow(state);
  } else {
    const model::System& system = batch.system(i);
    const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
    start = UnlistedStart{0, state, motion_from(system, z, patience, stop_), {}};
    if (is_set(stop_)) return std::nullopt;
    if (start->motion) start->name = motion_name(system.parameters(), *start->motion);
  }
  if (start) start->place = i;
  return start;
}

// A start that looks like one followed before has come to the same motion.
std::optional<UnlistedStart> StartRunner::unlisted_of_few(Batch& batch, std::size_t i, double now) const {
  const PilotRecord& record = (*batch.records)[i];
  const KnownFeatures* like = record.finished_window
                                  ? nearest_met(record.features, batch.looks, system_.balls(), search_.rule.sameness)
                                  : nullptr;
  if (like)
    return UnlistedStart{i, when_recognised(batch, i, now), batch.came_to[static_cast<std::size_t>(like->attractor)]};
  // To follow one past its strikes and stops takes longer than all starts together: its windows show the motion.
  if (!system_.smooth() && !system_.coasts())
    return UnlistedStart{i, when_recognised(batch, i, now), measured_motion(), {name_of(MotionKind::measured), "", 0}};
  if (batch.came_to.size() >= most_followed_of_few) return UnlistedStart{i, when_recognised(batch, i, now), {}};
  std::optional<UnlistedStart> start = unlisted_start(batch, i, now, 0.0);
  if (!start) return start;
  if (record.finished_window)
    batch.looks.push_back({.features = record.features,
                           .attractor = static_cast<int>(batch.came_to.size()),
                           .chaotic = !start->motion || never_repeats(start->motion->kind)});
  batch.came_to.push_back(start->motion);
  return start;
}

UnlistedStart StartRunner::met_again(const Batch& batch, std::size_t i, const Fate& fate) const {
  const Motion& motion = batch.own[i].met->motions[static_cast<std::size_t>(-fate.attractor - 1)];
  return {i, {motion.state.begin(), motion.state.end()}, motion, motion_name(batch.system(i).parameters(), motion)};
}

// The state from which a start is followed on, from time `now`. With a stroboscopic section it lies on the next
// section, so that it needs no rotor angle beside it.
std::vector<double> StartRunner::when_recognised(const Batch& batch, std::size_t i, double now) const {
  const model::System& system = batch.system(i);
  const Eigen::Map<const Eigen::VectorXd> z(batch.state(i), system.dimension());
  const model::Segment segment = family_ ? batch.starts.rotors[i].segment : source_->last_task().segment;
  const Eigen::VectorXd there = at_next_section(system, z, segment.psi_at(now)).value_or(z);
  return {there.begin(), there.end()};
}

}  // namespace equipoise
