// One study's starts, from index to fate.
#include "equipoise/fates/start_runner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "equipoise/deciding/window_features.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/last_speed.hpp"
#include "equipoise/fates/transient_tally.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/model/unbalance.hpp"
#include "equipoise/motions/motion_figures.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

// For what has been followed long beyond the horizon, and is at rest or repeats itself if it ever will.
constexpr double a_look = 1000.0;

// From dimensionless figures of one rotor to those of another.
void change_units(const model::Scales& from, const model::Scales& to, Fate& fate, TransientRow* row) {
  if (from.mass == to.mass && from.length == to.length && from.frequency == to.frequency) return;
  const double time = from.time() / to.time(), length = from.length / to.length, force = from.force() / to.force();
  const double velocity = from.velocity() / to.velocity(), unbalance = from.unbalance() / to.unbalance();
  const auto scale = [](float& value, double by) { value = static_cast<float>(value * by); };
  fate.time *= time;
  scale(fate.mean_speed, 1.0 / time);
  scale(fate.unbalance, unbalance);
  scale(fate.radius, length);
  if (!row) return;
  for (float TransientRow::*column :
       {&TransientRow::peak_radial, &TransientRow::peak_radial_after_release, &TransientRow::peak_radial_at_end})
    scale(row->*column, length);
  for (float TransientRow::*column : {&TransientRow::peak_force, &TransientRow::rms_force}) scale(row->*column, force);
  scale(row->rms_velocity, velocity);
  scale(row->energy, from.torque() / to.torque());
  scale(row->residual_unbalance, unbalance);
  for (float TransientRow::*column :
       {&TransientRow::time_above, &TransientRow::settling_time, &TransientRow::followed_until})
    scale(row->*column, time);
}

float unbalance_of(const model::System& system, const double* state) {
  return static_cast<float>(std::abs(model::unbalance(system.parameters(), state + model::index::phi(0))));
}

}  // namespace

// Starts under way, and what is known of each.
struct StartRunner::Batch {
  SpunUp starts;
  std::vector<FamilyStart> own;   // each start's study, where they differ; else empty
  std::vector<std::size_t> cell;  // of the mesh, of such
  TransientTable table;
  bool watched = false;
  std::vector<Fate> fates;
  std::optional<std::vector<PilotRecord>> records;  // of all starts, if wanted

  const Study& study(const StartRunner& runner, std::size_t i) const {
    return own.empty() ? runner.study_ : own[i].own.study;
  }
  const model::System& system(const StartRunner& runner, std::size_t i) const {
    return own.empty() ? runner.system_ : starts.rotors[i].system;
  }
  double end(const StartRunner& runner, std::size_t i) const {
    return own.empty() ? runner.source_->settled() + *runner.study_.numerics.horizon : starts.rotors[i].end;
  }
  const double* state(const StartRunner& runner, std::size_t i) const {
    return &starts.states[i * static_cast<std::size_t>(runner.system_.dimension())];
  }
};

StartRunner::StartRunner(const Study& study, const DiscoverySettings& settings, bool transients)
    : study_(with_horizon(study)),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(with_medians(study_), settings.stop)),
      sampler_(sampler_of(study_)) {
  if (study_.uncertain.empty()) {
    discovery_ = discover(study_, settings);
    catalogue_ = discovery_.catalogue;
  } else {
    family_.emplace(study_);
    // Rotors that coast have no attractors to search for: each is asked about its own balance.
    catalogue_ = Catalogue(true);
    if (!system_.coasts()) {
      mesh_ = mesh_of(study_, *family_, settings);
      catalogue_ = mesh_.catalogue;
    }
  }
  if (!transients) return;
  source_->watch(transients_);
  for (const Attractor& a : catalogue_.attractors()) {
    ends_.resize(std::max(ends_.size(), static_cast<std::size_t>(a.id) + 1));
    ends_[static_cast<std::size_t>(a.id)] = end_of(a.id);
  }
}

// Of a study with uncertain values, made once for all runs that share a cache.
FamilyMesh StartRunner::mesh_of(const Study& study, const StudyFamily& family, const DiscoverySettings& settings) {
  Study subject = study;
  subject.sampling = {};
  subject.limits = {};
  DiscoverySettings of_family = settings;
  of_family.family = to_toml(subject);
  if (!settings.cache) return discover_mesh(family, {}, of_family);
  std::string key = search_key(of_family.family, settings);
  if (const auto at = settings.cache->meshes.find(key); at != settings.cache->meshes.end()) return *at->second;
  FamilyMesh mesh = discover_mesh(family, {}, of_family);
  if (!mesh.stopped) settings.cache->meshes.emplace(std::move(key), std::make_shared<const FamilyMesh>(mesh));
  return mesh;
}

StartRunner::StartRunner(const Study& study, StudyFamily family, const FamilyStarts& starts,
                         const DiscoverySettings& settings)
    : study_(with_horizon(study)),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(study_, settings.stop)),
      sampler_(sampler_of(study_)),
      family_(std::move(family)),
      mesh_(discover_mesh(*family_, starts, settings)),
      catalogue_(mesh_.catalogue) {}

// Of rotors that differ none is known beforehand but the end that is none: exact balance.
KnownEnd StartRunner::end_of(int attractor) const {
  const KnownEnd end = known_end(study_.parameters, *catalogue_.find(attractor));
  if (!family_) return end;
  const bool exact = attractor == balanced_id && end.figures && end.figures->radial == 0.0;
  return exact ? end : KnownEnd{};
}

BalanceNote StartRunner::balance() const {
  if (!family_) return {discovery_.balanced.stable, discovery_.balanced.note};
  BalanceNote note;
  for (const FamilyCell& cell : mesh_.cells) {
    note.stable = note.stable || cell.discovery.balanced.stable;
    if (note.note.empty()) note.note = cell.discovery.balanced.note;
  }
  if (note.stable) note.note.clear();
  return note;
}

// What the rule says of all starts that are not over yet: those that are keep their fates.
bool StartRunner::decide(Batch& batch) const {
  batch.fates = batch.starts.fates;
  std::vector<std::vector<std::size_t>> cells(family_ ? mesh_.cells.size() : 1);
  for (std::size_t i = 0; i < batch.starts.size(); ++i) {
    if (batch.starts.is_over(i) || !(batch.starts.begin(i, source_->settled()) < batch.end(*this, i))) continue;
    cells[family_ ? batch.cell[i] : 0].push_back(i);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].empty()) continue;
    const DecisionRule& rule = family_ ? mesh_.cells[c].discovery.rule : discovery_.rule;
    if (!decide_some(batch, cells[c], rule)) return false;
    for (const std::size_t i : cells[c])
      if (family_) batch.fates[i].attractor = static_cast<short>(mesh_.cells[c].id(batch.fates[i].attractor));
  }
  return true;
}

bool StartRunner::decide_some(Batch& batch, const std::vector<std::size_t>& places, const DecisionRule& rule) const {
  const std::size_t size = system_.dimension();
  SpunUp& starts = batch.starts;
  LaneTask task = source_->last_task();
  task.end = source_->settled() + *study_.numerics.horizon;
  task.stop = stop_;
  std::vector<double> states, begins;
  std::vector<const OwnRotor*> own;
  TransientTable rows{transients_, {}, ends_};
  for (const std::size_t i : places) {
    states.insert(states.end(), &starts.states[i * size], &starts.states[i * size] + size);
    begins.push_back(starts.begin(i, source_->settled()));
    if (batch.watched) rows.rows.push_back(batch.table.rows[i]);
    if (!family_) continue;
    const FamilyCell& cell = mesh_.cells[batch.cell[i]];
    starts.rotors[i].coordinates = family_->coordinates(cell.box, batch.own[i].fractions);
    cell.discovery.place(starts.rotors[i]);
    if (const MetMotions* met = batch.own[i].met) starts.rotors[i].met = &met->known;
    own.push_back(&starts.rotors[i]);
    if (batch.watched) rows.own.push_back(batch.table.own[i]);
  }
  task.count = places.size();
  task.states = states.data();
  task.begins = begins.data();
  if (family_) task.own = own.data();
  if (batch.watched) task.transients = &rows;
  std::vector<Fate> decided(places.size());
  for (std::size_t k = 0; k < places.size(); ++k) decided[k].met = starts.fates[places[k]].met;
  std::vector<PilotRecord> records(batch.records ? places.size() : 0);
  if (!decide_lanes(task, rule, decided, batch.records ? &records : nullptr)) return false;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t i = places[k];
    batch.fates[i] = decided[k];
    if (batch.records) (*batch.records)[i] = records[k];
    std::copy_n(&states[k * size], size, &starts.states[i * size]);
    if (batch.watched) batch.table.rows[i] = rows.rows[k];
  }
  return true;
}

bool StartRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
                      std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  if (family_) {
    std::vector<DrawnStart> drawn;
    for (std::size_t i = 0; i < count; ++i) drawn.push_back({first + i, fractions_of(first + i)});
    return run_drawn(drawn, phi, fates, unlisted, rows);
  }
  Batch batch;
  batch.watched = rows != nullptr;
  batch.table = {transients_, {}, ends_};
  if (!source_->make(study_.sampling.seed, first, count, batch.starts, rows ? &batch.table : nullptr)) return false;
  if (!finish(batch, fates, unlisted, rows)) return false;
  phi = batch.starts.phi;
  return true;
}

bool StartRunner::run_from(std::span<const InitialState> given, std::vector<Fate>& fates,
                           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  if (family_) return Runner::run_from(given, fates, unlisted, rows);
  Batch batch;
  batch.watched = rows != nullptr;
  batch.table = {transients_, {}, ends_};
  return source_->follow(parted(study_.parameters, given), batch.starts, rows ? &batch.table : nullptr) &&
         finish(batch, fates, unlisted, rows);
}

std::vector<double> StartRunner::fractions_of(std::uint64_t number) const {
  return drawn_fractions(study_, sampler_, study_.sampling.seed, number);
}

bool StartRunner::run_drawn(std::span<const DrawnStart> drawn, std::vector<double>& phi, std::vector<Fate>& fates,
                            std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  const int balls = study_.parameters.balls;
  std::vector<std::size_t> places;  // of starts whose values make a study
  std::vector<FamilyStart> starts;
  phi.clear();
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    InitialState start;
    try {
      Study study = family_->at(family_->values_at(drawn[i].fractions));
      start = start_of(study, sampler_, study_.sampling.seed, drawn[i].number);
      const InitialState apart = parted(study.parameters, start);
      starts.push_back({{std::move(study), apart}, drawn[i].fractions});
      places.push_back(i);
    } catch (const InputError&) {  // beyond the ends that were tried
      start = start_of(study_, sampler_, study_.sampling.seed, drawn[i].number);
    }
    phi.insert(phi.end(), start.phi.begin(), start.phi.begin() + balls);
  }
  std::vector<Fate> decided;
  std::vector<TransientRow> figures;
  if (!run_family(std::move(starts), decided, unlisted, rows ? &figures : nullptr)) return false;
  Fate none;
  none.outcome = Outcome::failed;
  fates.assign(drawn.size(), none);
  if (rows) rows->assign(drawn.size(), transient_row({}, {}, true));
  for (std::size_t k = 0; k < places.size(); ++k) {
    fates[places[k]] = decided[k];
    if (rows) (*rows)[places[k]] = figures[k];
  }
  for (UnlistedStart& u : unlisted) {
    u.place = places[u.place];
    u.state = {static_cast<double>(drawn[u.place].number)};
  }
  return true;
}

// Starts of the family's rotors, each in the units of the study's medians.
bool StartRunner::run_family(std::vector<FamilyStart> given, std::vector<Fate>& fates,
                             std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  if (system_.coasts()) return run_coasting(given, fates, unlisted, rows);
  Batch batch;
  if (!begin_family(std::move(given), rows != nullptr, batch) || !finish(batch, fates, unlisted, rows)) return false;
  for (std::size_t i = 0; i < fates.size(); ++i)
    if (const auto& scales = batch.own[i].own.study.scales)
      change_units(*scales, *study_.scales, fates[i], rows ? &(*rows)[i] : nullptr);
  return true;
}

bool StartRunner::begin_family(std::vector<FamilyStart> given, bool watched, Batch& batch) const {
  batch.watched = watched;
  batch.table = {transients_, {}, ends_};
  std::vector<OwnStart> starts;
  for (const FamilyStart& g : given) {
    starts.push_back(g.own);
    batch.cell.push_back(mesh_.index(g.fractions));
    if (watched) batch.table.own.push_back(transient_settings(g.own.study));
  }
  batch.own = std::move(given);
  if (!spin_up_own(starts, stop_, batch.starts, watched ? &batch.table : nullptr)) return false;
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (follows_open(batch, i)) batch.starts.rotors[i].end += FamilyCell::further;
  return true;
}

bool StartRunner::follows_open(const Batch& batch, std::size_t i) const {
  const MetMotions* met = batch.own[i].met;
  return mesh_.cells[batch.cell[i]].follows_open && (!met || met->follows_open);
}

// One after the other, so that each motion is followed once.
bool StartRunner::meet(std::vector<FamilyStart> given, std::span<const std::size_t> rotor,
                       std::span<MetMotions> met) const {
  Batch batch;
  batch.records.emplace(given.size());
  if (!begin_family(std::move(given), false, batch) || !decide(batch)) return false;
  std::vector<int> late(met.size()), settled(met.size());  // of those that the horizon left open
  std::vector<char> restless(met.size());                  // one of the rotor's starts comes to nothing
  for (std::size_t i = 0; i < batch.fates.size(); ++i) {
    const Fate& fate = batch.fates[i];
    const std::size_t r = rotor[i];
    const double further = follows_open(batch, i) ? FamilyCell::further : 0.0;
    const bool was_open = fate.time >= batch.end(*this, i) - further;
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

// Adds what a start comes to, unless that has been met. False if it comes to nothing, or stopped.
bool StartRunner::meet(const Batch& batch, std::size_t i, MetMotions& met) const {
  const PilotRecord& record = (*batch.records)[i];
  if (!record.finished_window) return false;
  const double sameness = mesh_.cells[batch.cell[i]].discovery.rule.sameness;
  if (nearest_met(record.features, met.known, study_.parameters.balls, sameness)) return true;
  const std::optional<UnlistedStart> start = unlisted_start(batch, i, batch.fates[i].time, lasting_chaos);
  if (!start || !start->motion || !start->motion->stable) return false;
  if (start->motion->set_valued) return true;  // balls that dry friction holds stay each where they are
  met.motions.push_back(*start->motion);
  met.known.push_back({.features = record.features,
                       .attractor = -static_cast<int>(met.motions.size()),
                       .chaotic = never_repeats(start->motion->kind)});
  return true;
}

// One rotor after the other.
bool StartRunner::run_coasting(std::span<const FamilyStart> given, std::vector<Fate>& fates,
                               std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  fates.clear();
  unlisted.clear();
  if (rows) rows->clear();
  for (std::size_t i = 0; i < given.size(); ++i) {
    const Study& study = given[i].own.study;
    StartRunner alone(study, {.stop = stop_}, rows != nullptr);
    std::vector<Fate> one;
    std::vector<UnlistedStart> none;
    std::vector<TransientRow> row;
    if (!alone.run_from({&given[i].own.start, 1}, one, none, rows ? &row : nullptr)) return false;
    for (const UnlistedStart& u : none) settle(alone, u, one.front());
    Fate& fate = fates.emplace_back(one.front());
    if (const Attractor* a = alone.catalogue().find(fate.attractor); a && fate.outcome == Outcome::attracted) {
      unlisted.push_back({i, {}, a->motion, {a->name, a->alias, a->id < first_free_id ? a->id : 0}});
      unlisted.back().motion->stable = true;
      fate.attractor = 0;
    }
    if (rows) rows->push_back(row.front());
    if (study.scales) change_units(*study.scales, *study_.scales, fate, rows ? &rows->back() : nullptr);
  }
  return true;
}

// Decides starts and says what each came to.
bool StartRunner::finish(Batch& batch, std::vector<Fate>& fates, std::vector<UnlistedStart>& unlisted,
                         std::vector<TransientRow>* rows) const {
  if (!decide(batch) || !note_last_speeds(batch)) return false;
  const std::size_t count = batch.starts.size();
  fates = std::move(batch.fates);
  unlisted.clear();
  if (rows) rows->assign(count, TransientRow{});
  for (std::size_t i = 0; i < count; ++i) {
    Fate& fate = fates[i];
    const model::System& system = batch.system(*this, i);
    // At the horizon a rotor of its own is not undecided for want of a list that holds for it.
    const bool open = family_ && fate.outcome == Outcome::undecided && !batch.starts.is_over(i) &&
                      fate.time >= batch.end(*this, i) && follows_open(batch, i);
    if (open) fate.outcome = Outcome::attracted;
    const bool attracted = fate.outcome == Outcome::attracted;
    std::optional<MotionFigures> end;
    if (attracted && fate.attractor <= 0) {
      // A watched trajectory has gone on since it was decided.
      const double now = rows ? batch.table.rows[i].end : fate.time;
      std::optional<UnlistedStart> start =
          fate.attractor < 0 ? met_again(batch, i, fate) : unlisted_start(batch, i, now, open ? a_look : lasting_chaos);
      if (!start) return false;
      unlisted.push_back(*std::move(start));
      fate.attractor = 0;
      fate.by = DecidedBy::followed;
      const auto& motion = unlisted.back().motion;
      if (motion && !system.prescribed()) fate.mean_speed = static_cast<float>(motion->speed);
      if (motion && motion->set_valued) fate.unbalance = unbalance_of(system, motion->state.data());
      if (rows && motion && motion->stable) end = motion_figures(system.parameters(), *motion);
    } else if (attracted) {
      if (system_.coasts()) fate.by = DecidedBy::followed;
      fate.mean_speed = static_cast<float>(mean_speed(batch, i, fate));
      end = batch.table.end_of(fate.attractor).figures;
    }
    if (attracted && fate.attractor > 0) note_unbalance(batch, i, fate);
    // Whatever its motion is called: what the study's motor was to do it did not.
    if (attracted && !system.prescribed() && std::fabs(fate.mean_speed) < batch.study(*this, i).stall_speed())
      fate.outcome = Outcome::stalled;
    if (!rows) continue;
    const bool lost = fate.outcome == Outcome::diverged || fate.outcome == Outcome::failed;
    (*rows)[i] = transient_row(settings_of(batch, i), batch.table.rows[i], lost, end);
  }
  return true;
}

// Of starts whose fate the horizon left open. What runs away turns ever faster.
bool StartRunner::note_last_speeds(Batch& batch) const {
  if (system_.prescribed()) return true;
  const std::size_t size = system_.dimension();
  const LaneTask task = source_->last_task();
  std::vector<std::size_t> places;
  std::vector<double> states;
  std::vector<OwnRotor> own;
  for (std::size_t i = 0; i < batch.starts.size(); ++i) {
    Fate& fate = batch.fates[i];
    if (fate.outcome != Outcome::undecided || batch.starts.is_over(i)) continue;
    const double* state = batch.state(*this, i);
    fate.mean_speed = static_cast<float>(state[task.layout().speed]);
    if (fate.time < batch.end(*this, i)) continue;
    places.push_back(i);
    states.insert(states.end(), state, state + size);
    if (family_) own.push_back(batch.starts.rotors[i]);
  }
  if (places.empty()) return true;
  const double horizon = source_->settled() + *study_.numerics.horizon;
  const std::vector<double> speeds = mean_speeds_from(task, std::move(states), horizon, std::move(own));
  for (std::size_t k = 0; k < speeds.size(); ++k) batch.fates[places[k]].mean_speed = static_cast<float>(speeds[k]);
  return !speeds.empty();
}

// Balls that dry friction holds leave each their own.
void StartRunner::note_unbalance(const Batch& batch, std::size_t i, Fate& fate) const {
  const Attractor* a = catalogue_.find(fate.attractor);
  if (a && a->motion.set_valued) fate.unbalance = unbalance_of(batch.system(*this, i), batch.state(*this, i));
}

// Of a driven rotor, its attractor's own: a trap may catch it before it has turned for long. One that coasts keeps what
// speed it has in balance, and else ends without any.
double StartRunner::mean_speed(const Batch& batch, std::size_t i, const Fate& fate) const {
  if (system_.prescribed()) return fate.mean_speed;
  if (system_.coasts()) return fate.attractor == balanced_id ? batch.state(*this, i)[system_.layout().speed] : 0.0;
  if (family_ && fate.attractor == balanced_id)
    return model::balanced_speed(batch.system(*this, i)).value_or(fate.mean_speed);
  // What windows tell has turned at its speed for long, what a trap has caught may still be on its way up to it.
  const bool seen = fate.by == DecidedBy::windows || fate.by == DecidedBy::horizon;
  const Attractor* a = family_ && seen && !std::isnan(fate.mean_speed) ? nullptr : catalogue_.find(fate.attractor);
  return a && a->motion.kind != MotionKind::measured ? a->motion.speed : fate.mean_speed;
}

// A motor lets go of each start's balls at a time of its own.
TransientSettings StartRunner::settings_of(const Batch& batch, std::size_t i) const {
  TransientSettings settings = batch.table.settings_of(i);
  if (!batch.starts.released.empty()) settings.release = batch.starts.released[i];
  return settings;
}

// `patience`: for a rotor of its own.
std::optional<UnlistedStart> StartRunner::unlisted_start(const Batch& batch, std::size_t i, double now,
                                                         double patience) const {
  const std::vector<double> state = when_recognised(batch, i, now);
  std::optional<UnlistedStart> start;
  if (!family_) {
    start = follow(state);
  } else {
    const model::System& system = batch.system(*this, i);
    const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
    start = UnlistedStart{0, state, motion_from(system, z, patience, stop_), {}};
    if (is_set(stop_)) return std::nullopt;
    if (start->motion) start->name = motion_name(system.parameters(), *start->motion);
  }
  if (start) start->place = i;
  return start;
}

UnlistedStart StartRunner::met_again(const Batch& batch, std::size_t i, const Fate& fate) const {
  const Motion& motion = batch.own[i].met->motions[static_cast<std::size_t>(-fate.attractor - 1)];
  return {
      i, {motion.state.begin(), motion.state.end()}, motion, motion_name(batch.system(*this, i).parameters(), motion)};
}

std::vector<UndecidedEnd> StartRunner::look_at(const std::vector<InitialState>& undecided) const {
  std::vector<UndecidedEnd> ends;
  if (family_) return ends;  // a start alone does not say which rotor it drew
  for (const InitialState& given : undecided) {
    Batch batch;
    if (!source_->follow(parted(study_.parameters, {&given, 1}), batch.starts)) break;
    if (batch.starts.is_over(0)) {
      ends.push_back({.what = Restlessness::held, .reached = batch.starts.nearest[0], .asked = *study_.release.speed});
      continue;
    }
    if (!decide(batch)) break;
    const std::vector<double> z = when_recognised(batch, 0, batch.fates[0].time);
    const Eigen::Map<const Eigen::VectorXd> state(z.data(), static_cast<Eigen::Index>(z.size()));
    ends.push_back(look_at_undecided(system_, state));
    if (system_.prescribed()) continue;
    const float before = batch.fates[0].mean_speed;
    if (!note_last_speeds(batch)) break;
    const double now = batch.fates[0].mean_speed;
    const Restlessness of_rotor = restlessness(before, batch.fates[0], batch.starts.begin(0, source_->settled()));
    UndecidedEnd& end = ends.back();
    const bool changes = of_rotor == Restlessness::speeding_up || of_rotor == Restlessness::changing_speed;
    const bool waits_for_speed = end.what == Restlessness::creeping || end.what == Restlessness::near_balance;
    if (end.what == Restlessness::regular || (changes && waits_for_speed)) end.what = of_rotor;
    if (end.what == Restlessness::speeding_up) end.reached = std::fabs(now);
  }
  return ends;
}

// Of a driven rotor that is not chaotic: whether its speed when it was last seen is the mean of its last long window,
// `before`; or that it was not watched for as many short ones as tell one from the next.
Restlessness StartRunner::restlessness(double before, const Fate& fate, double begin) const {
  constexpr double steady = 0.02;
  constexpr int fewest_windows = 8;
  const double now = fate.mean_speed;
  if (fate.time - begin < fewest_windows * discovery_.rule.window) return Restlessness::hardly_seen;
  if (!(std::fabs(now - before) > steady * std::fabs(now))) return Restlessness::regular;
  return std::fabs(now) > std::fabs(before) ? Restlessness::speeding_up : Restlessness::changing_speed;
}

// The state at time `now` as a start is followed further from it: at a prescribed speed with anisotropy or gravity one
// at a strobe, so that it needs no angle beside it.
std::vector<double> StartRunner::when_recognised(const Batch& batch, std::size_t i, double now) const {
  const model::System& system = batch.system(*this, i);
  const Eigen::Map<const Eigen::VectorXd> z(batch.state(*this, i), system.dimension());
  std::vector<double> result(z.begin(), z.end());
  if (system.section() != model::Section::strobe) return result;
  const model::Segment segment = family_ ? batch.starts.rotors[i].segment : source_->last_task().segment;
  const auto at_strobe = at_next_strobe(system, z, segment.psi_at(now));
  if (at_strobe) result.assign(at_strobe->begin(), at_strobe->end());
  return result;
}

std::optional<UnlistedStart> StartRunner::follow(const std::vector<double>& state) const {
  if (family_) {  // the number of a start
    const auto number = static_cast<std::uint64_t>(state.front());
    std::vector<double> phi;
    std::vector<Fate> fates;
    std::vector<UnlistedStart> unlisted;
    const DrawnStart drawn{number, fractions_of(number)};
    if (!run_drawn({&drawn, 1}, phi, fates, unlisted)) return std::nullopt;
    return unlisted.empty() ? UnlistedStart{0, state, {}, {}} : std::move(unlisted.front());
  }
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  UnlistedStart start{0, state, {}, {}};
  if (discovery_.coasting)
    start.motion = discovery_.coasting->lasting_motion(z, stop_);
  else
    start.motion = motion_from(system_, z, followed_for(system_), stop_);
  if (is_set(stop_)) return std::nullopt;  // its motion may have been cut short
  return start;
}

int StartRunner::list(const UnlistedStart& start) {
  const bool stable = start.motion && start.motion->stable;
  if (!stable) return 0;
  if (!family_ && !system_.coasts()) return catalogue_.add(study_.parameters, *start.motion);
  return catalogue_.add(family_ ? start.name : motion_name(study_.parameters, *start.motion), *start.motion);
}

}  // namespace equipoise
