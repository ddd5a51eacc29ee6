// Decides a batch of starts: first by the rule, then each unlisted one by following it to its motion.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "equipoise/attractors/motions/motion_figures.hpp"
#include "equipoise/attractors/periodic_orbits/stroboscopic_section.hpp"
#include "equipoise/classification/attractor_search/search.hpp"
#include "equipoise/classification/start_runs/batch.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/model/unbalance.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/rule/window_features.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

// Patience for a trajectory followed far beyond the horizon: it rests or repeats itself by now, or never will.
constexpr double a_look = 1000.0;

float unbalance_of(const model::System& system, const double* state) {
  return static_cast<float>(std::abs(model::unbalance(system.parameters(), state + model::index::phi(0))));
}

Eigen::Map<const Eigen::VectorXd> vector_of(const std::vector<double>& state) {
  return {state.data(), static_cast<Eigen::Index>(state.size())};
}

}  // namespace

bool Session::Batch::begin(std::uint64_t first, std::size_t count) {
  return s_.source_->make(s_.study_.sampling.seed, first, count, starts_, watched_table());
}

bool Session::Batch::begin(std::span<const InitialState> given) {
  return s_.source_->follow(parted(s_.study_.parameters, given), starts_, watched_table());
}

// Applies the rule to all starts that are not over; the others keep their outcomes.
bool Session::Batch::classify() {
  outcomes_ = starts_.outcomes;
  if (few()) records_.emplace(starts_.size());
  std::vector<std::vector<std::size_t>> places(s_.mesh_.cells.size());
  for (std::size_t i = 0; i < starts_.size(); ++i)
    if (!starts_.is_over(i) && begin_of(i) < end(i)) places[own_.empty() ? 0 : cell_[i]].push_back(i);
  for (std::size_t c = 0; c < places.size(); ++c)
    if (!places[c].empty() && !classify(s_.mesh_.cells[c], places[c])) return false;
  return true;
}

bool Session::Batch::classify(const FamilyCell& cell, const std::vector<std::size_t>& places) {
  const std::size_t size = s_.system_.dimension();
  BatchTask task = s_.source_->last_task();
  task.end = horizon();
  std::vector<double> states, begins;
  std::vector<const OwnRotor*> own;
  TransientTable rows;
  if (watched_) rows = table_.part(places);
  for (const std::size_t i : places) {
    states.insert(states.end(), state(i), state(i) + size);
    begins.push_back(begin_of(i));
    if (own_.empty()) continue;
    OwnRotor& rotor = starts_.rotors[i];
    rotor.coordinates = s_.family_->coordinates(cell.box, own_[i].fractions);
    cell.search.place(rotor);
    if (const MetMotions* met = own_[i].met) rotor.met = &met->known;
    own.push_back(&rotor);
  }
  task.take(states, own, begins);
  if (watched_) task.transients = &rows;
  std::vector<Outcome> decided(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) decided[k].met = starts_.outcomes[places[k]].met;
  std::vector<PilotRecord> records(records_ ? places.size() : 0);
  if (!classify_batch(task, cell.search.rule, decided, records_ ? &records : nullptr)) return false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t i = places[k];
    outcomes_[i] = decided[k];
    outcomes_[i].attractor = static_cast<short>(cell.id(decided[k].attractor));
    if (records_) (*records_)[i] = records[k];
    std::copy_n(&states[k * size], size, &starts_.states[i * size]);
  }
  if (watched_) table_.put_back(places, rows);
  return true;
}

bool Session::Batch::finish(Decided& decided) {
  if (!classify() || !note_last_speeds() || !note_radii()) return false;
  const std::size_t count = starts_.size();
  decided.unlisted.clear();
  decided.transients.assign(watched_ ? count : 0, TransientRow{});
  for (std::size_t i = 0; i < count; ++i) {
    Outcome& outcome = outcomes_[i];
    std::optional<UnlistedStart> unlisted;
    std::optional<MotionFigures> end;  // of its motion, if known
    // No list need hold for a rotor of the start's own, so it is followed beyond the horizon if that pays.
    // The rule gives an undecided start the attractor that its windows are most like, if that is chaotic.
    const bool left = is_left(i), like_chaos = left && outcome.attractor > 0;
    const bool in_listed_chaos = like_chaos && is_in_chaos(i, when_recognised(i, outcome.time), outcome.time);
    if (!in_listed_chaos && outcome.kind == OutcomeKind::undecided) outcome.attractor = 0;
    if (in_listed_chaos) outcome.by = DecidedBy::horizon;
    const bool open = left && !in_listed_chaos && follows_open(i);
    if (open || in_listed_chaos) outcome.kind = OutcomeKind::attracted;
    const bool arrives = outcome.kind == OutcomeKind::attracted;
    if (arrives && outcome.attractor <= 0) {
      unlisted = follow_on(i, open);
      if (!unlisted) return false;
      const std::optional<Motion>& motion = unlisted->motion;
      if (watched_ && motion && motion->kind != MotionKind::measured && motion->stable)
        end = motion_figures(system(i).parameters(), *motion, table_.settings_of(i).shaft);
    } else if (arrives) {
      if (s_.system_.coasts()) outcome.by = DecidedBy::followed;
      outcome.mean_speed = static_cast<float>(mean_speed(i));
      end = table_.end_of(outcome.attractor).figures;
      // Balls held by dry friction leave a different unbalance after each start.
      const Attractor* listed = s_.catalogue().find(outcome.attractor);
      if (listed && listed->motion.set_valued) outcome.unbalance = unbalance_of(system(i), state(i));
    } else if (left && !like_chaos && is_in_chaos(i, when_recognised(i, outcome.time), outcome.time)) {
      unlisted = in_chaos(i, outcome.time);
      outcome.kind = OutcomeKind::attracted;
      outcome.by = DecidedBy::horizon;
    }
    // Whatever its motion is called, the motor did not bring the rotor up to speed.
    if (arrives && !s_.system_.prescribed() && std::fabs(outcome.mean_speed) < study(i).stall_speed())
      outcome.kind = OutcomeKind::stalled;
    if (unlisted) decided.unlisted.push_back(*std::move(unlisted));
    if (watched_) decided.transients[i] = row(i, end);
  }
  decided.outcomes = std::move(outcomes_);
  return true;
}

// Not decided by the horizon.
bool Session::Batch::is_left(std::size_t i) const {
  return outcomes_[i].kind == OutcomeKind::undecided && !starts_.is_over(i) && outcomes_[i].time >= end(i);
}

bool Session::Batch::follows_open(std::size_t i) const {
  if (own_.empty()) return false;
  const MetMotions* met = own_[i].met;
  return cell(i).follows_open && (!met || met->follows_open);
}

// Follows a start that the rule does not name to its motion. `open`: the horizon left it.
std::optional<UnlistedStart> Session::Batch::follow_on(std::size_t i, bool open) {
  Outcome& outcome = outcomes_[i];
  // A watched trajectory has gone on since it was decided.
  const double now = watched_ ? table_.rows[i].end : outcome.time;
  double patience = own_.empty() ? followed_for(s_.system_, s_.mode_) : open ? a_look : lasting_chaos;
  std::optional<UnlistedStart> start = outcome.attractor < 0 ? met_again(i)
                                       : few()               ? unlisted_of_few(i, now)
                                                             : followed(i, now, patience);
  if (!start) return start;
  // Few starts are not all followed.
  const bool chaos = !start->motion && !few() && is_in_chaos(i, start->state, now + patience);
  if (chaos && open) {
    // Chaos that outlasts the horizon is the motion of this rotor if it can be described, as a search would list it.
    patience = lasting_chaos;
    start = followed(i, now, patience);
    if (!start) return start;
  }
  if (chaos && !start->motion) {
    start = in_chaos(i, now);
    outcome.time = std::max(outcome.time, now + patience);
  }
  const std::optional<Motion>& motion = start->motion;
  const bool measured = motion && motion->kind == MotionKind::measured;
  outcome.attractor = 0;
  outcome.by = measured ? DecidedBy::windows : DecidedBy::followed;
  if (motion && !measured && !system(i).prescribed()) outcome.mean_speed = static_cast<float>(motion->speed);
  if (motion && motion->set_valued) outcome.unbalance = unbalance_of(system(i), motion->state.data());
  return start;
}

// Of a trajectory that came to nothing until `followed`. Exponents are those of the linearised equations, which
// meetings of balls break off.
bool Session::Batch::is_in_chaos(std::size_t i, const std::vector<double>& state, double followed) const {
  if (!system(i).smooth() || s_.system_.coasts() || followed - s_.settled() < lasting_chaos) return false;
  return look_at_undecided(system(i), vector_of(state)).what == Restlessness::chaotic;
}

UnlistedStart Session::Batch::in_chaos(std::size_t i, double now) const {
  return {i, when_recognised(i, now), measured_motion(), {long_lived_chaos, "", 0}};
}

// The mean speed of a driven rotor is its attractor's, for a trapping region may catch it before it has turned for
// long. A coasting rotor keeps the speed that it has in balance; any other end is at rest.
double Session::Batch::mean_speed(std::size_t i) const {
  const Outcome& outcome = outcomes_[i];
  const bool balanced = outcome.attractor == balanced_id;
  if (s_.system_.prescribed()) return outcome.mean_speed;
  if (s_.system_.coasts()) return balanced ? state(i)[s_.system_.layout().speed] : 0.0;
  if (!own_.empty() && balanced) return model::balanced_speed(system(i)).value_or(outcome.mean_speed);
  // A start decided by windows has long turned at its speed. One caught by a trapping region may still be speeding up.
  const bool seen = outcome.by == DecidedBy::windows || outcome.by == DecidedBy::horizon;
  const bool own_mean = !own_.empty() && seen && !std::isnan(outcome.mean_speed);
  const Attractor* a = own_mean ? nullptr : s_.catalogue().find(outcome.attractor);
  return a && a->motion.kind != MotionKind::measured ? a->motion.speed : outcome.mean_speed;
}

TransientRow Session::Batch::row(std::size_t i, const std::optional<MotionFigures>& end) const {
  const bool lost = outcomes_[i].kind == OutcomeKind::diverged || outcomes_[i].kind == OutcomeKind::failed;
  TransientSettings settings = table_.settings_of(i);
  // A motor releases the balls of each start at a different time.
  if (!starts_.released.empty()) settings.release = starts_.released[i];
  return transient_row(settings, table_.rows[i], lost, end);
}

// `patience` applies to a start with a rotor of its own.
std::optional<UnlistedStart> Session::Batch::followed(std::size_t i, double now, double patience) const {
  const std::vector<double> state = when_recognised(i, now);
  std::optional<UnlistedStart> start;
  if (own_.empty()) {
    start = s_.follow(state);
  } else {
    start = UnlistedStart{0, state, motion_from(system(i), vector_of(state), patience, s_.stop_), {}};
    if (is_set(s_.stop_)) return std::nullopt;
    if (start->motion) start->name = motion_name(system(i).parameters(), *start->motion);
  }
  if (start) start->place = i;
  return start;
}

// A start that looks like one followed before has reached the same motion.
std::optional<UnlistedStart> Session::Batch::unlisted_of_few(std::size_t i, double now) {
  const PilotRecord& record = (*records_)[i];
  const KnownFeatures* like =
      record.finished_window ? nearest_met(record.features, looks_, s_.system_.balls(), cell(i).search.rule.sameness)
                             : nullptr;
  if (like) {
    UnlistedStart again = came_to_[static_cast<std::size_t>(like->attractor)];
    again.place = i;
    again.state = when_recognised(i, now);
    return again;
  }
  // To follow one past its strikes and stops takes longer than all starts together: its windows show the motion.
  if (!s_.system_.smooth() && !s_.system_.coasts())
    return UnlistedStart{i, when_recognised(i, now), measured_motion(), {name_of(MotionKind::measured), "", 0}};
  if (came_to_.size() >= most_followed_of_few) return UnlistedStart{i, when_recognised(i, now), {}};
  std::optional<UnlistedStart> start = followed(i, now, 0.0);
  if (!start) return start;
  if (record.finished_window)
    looks_.push_back({.features = record.features,
                      .attractor = static_cast<int>(came_to_.size()),
                      .chaotic = !start->motion || never_repeats(start->motion->kind)});
  came_to_.push_back(*start);
  return start;
}

UnlistedStart Session::Batch::met_again(std::size_t i) const {
  const Motion& motion = own_[i].met->motions[static_cast<std::size_t>(-outcomes_[i].attractor - 1)];
  return {i, {motion.state.begin(), motion.state.end()}, motion, motion_name(system(i).parameters(), motion)};
}

// The state from which a start is followed on, from time `now`. With a stroboscopic section it lies on the next
// section, so that it needs no rotor angle next to it.
std::vector<double> Session::Batch::when_recognised(std::size_t i, double now) const {
  const Eigen::Map<const Eigen::VectorXd> z(state(i), system(i).dimension());
  const model::Segment segment = own_.empty() ? s_.source_->last_task().segment : starts_.rotors[i].segment;
  const Eigen::VectorXd there = at_next_section(system(i), z, segment.psi_at(now)).value_or(z);
  return {there.begin(), there.end()};
}

std::optional<UndecidedEnd> Session::Batch::look() {
  if (starts_.is_over(0))
    return UndecidedEnd{
        .what = Restlessness::clamped, .reached = starts_.nearest[0], .asked = *s_.study_.release.speed};
  if (!classify()) return std::nullopt;
  UndecidedEnd end = look_at_undecided(s_.system_, vector_of(when_recognised(0, outcomes_[0].time)));
  if (outcomes_[0].kind == OutcomeKind::attracted && end.what == Restlessness::regular)
    end.what = Restlessness::unidentified;
  if (s_.system_.prescribed()) return end;
  const float before = outcomes_[0].mean_speed;
  if (!note_last_speeds()) return std::nullopt;
  const Restlessness of_rotor = restlessness(before);
  const bool changes = of_rotor == Restlessness::speeding_up || of_rotor == Restlessness::changing_speed;
  const bool waits_for_speed = end.what == Restlessness::creeping || end.what == Restlessness::near_balance;
  if (end.what == Restlessness::regular || (changes && waits_for_speed)) end.what = of_rotor;
  if (end.what == Restlessness::speeding_up) end.reached = std::fabs(static_cast<double>(outcomes_[0].mean_speed));
  return end;
}

// Compares a driven rotor's last speed with `before`, the mean over its last long window. For motions that are not
// chaotic. hardly_seen: it was watched over too few short windows to compare them.
Restlessness Session::Batch::restlessness(double before) const {
  constexpr double steady = 0.02;
  constexpr int fewest_windows = 8;
  const double now = outcomes_[0].mean_speed;
  if (outcomes_[0].time - begin_of(0) < fewest_windows * cell(0).search.rule.window) return Restlessness::hardly_seen;
  if (!(std::fabs(now - before) > steady * std::fabs(now))) return Restlessness::regular;
  return std::fabs(now) > std::fabs(before) ? Restlessness::speeding_up : Restlessness::changing_speed;
}

}  // namespace equipoise
