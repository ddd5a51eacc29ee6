// One study's starts, from index to fate.
#include "equipoise/fates/start_runner.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "equipoise/discovery/cost.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/last_speed.hpp"
#include "equipoise/fates/transient_tally.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/speed.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"
#include "equipoise/model/unbalance.hpp"
#include "equipoise/motions/motion_figures.hpp"
#include "equipoise/orbits/stroboscopic.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/transients/clamped_transients.hpp"

namespace equipoise {

namespace {

const char* final_speed_key(const Study& study) {
  const Profile profile = study.speed.profile;
  return profile == Profile::constant ? "speed.speed" : profile == Profile::points ? "speed.speeds" : "speed.final";
}

// What sets the time of release.
const char* release_key(const Study& study) {
  if (study.release.speed) return "release.speed";
  if (study.release.time) return "release.time";
  const Profile profile = study.speed.profile;
  return profile == Profile::trapezoid ? "speed.rise_until"
         : profile == Profile::points  ? "speed.times"
                                       : "speed.duration";
}

// A key of the study in which a need is not met, and its value.
std::pair<const char*, std::string> blamed(const Study& study, model::Need need) {
  using model::Need;
  const model::Parameters& p = study.parameters;
  const auto number = [](double v) { return fmt::format("{}", v); };
  const auto pair = [](const std::array<double, 2>& v) { return fmt::format("[{}, {}]", v[0], v[1]); };
  const auto supports = [&]() -> std::pair<const char*, std::string> {
    if (p.stiffness[0] != p.stiffness[1]) return {"rotor.stiffness", pair(p.stiffness)};
    return {"rotor.damping", pair(p.damping)};
  };
  switch (need) {
    case Need::prescribed_speed:
      return {"speed.profile", "torque"};
    case Need::passing_balls:
      return {"balancer.contact_angle", number(p.contact_angle)};
    case Need::sliding_balls:
      if (p.rolling[0] > 0.0) return {"balancer.rolling", number(p.rolling[0])};
      return {"balancer.stiction", number(p.stiction[0])};
    case Need::centred_race:
      return {"balancer.race_offset", pair(p.race_offset)};
    case Need::equal_supports:
      return supports();
    case Need::no_gravity:
      return {"rotor.gravity", number(p.gravity)};
    case Need::turning:
      return {final_speed_key(study), "0"};
    case Need::lasting_drive:
      return {"speed.torque", "0 in the end"};
    default:
      if (p.gravity != 0.0) return {"rotor.gravity", number(p.gravity)};
      return supports();
  }
}

void reject_if_lacking(const Study& study, model::Answer answer) {
  const auto lack = model::lacking(study.system(), answer, balance_is_even);
  if (!lack) return;
  const auto [key, value] = blamed(study, lack->need);
  throw InputError(study.name, key, value, lack->reason);
}

}  // namespace

void check_watchable(const Study& study) {
  const double release = study.release_time();
  const double points = clamped_grid_points(study.parameters, model::segments(study.speed_profile(), release));
  if (points <= most_clamped_grid_points) return;
  throw InputError(study.name, release_key(study), fmt::format("{:.6g}", study.release.speed.value_or(release)),
                   fmt::format("holds the balls until t = {:.6g}, too long to watch for transients; must be release by "
                               "about t = {:.3g}, or a study without [limits], its transients not asked for",
                               release, release * (most_clamped_grid_points / points)));
}

void check_decidable(const Study& study) {
  check(study);
  check_cost(study);
  const double speed = study.speed_profile().final_speed();
  if (std::fabs(speed) > fastest_speed)
    throw InputError(
        study.name, final_speed_key(study), fmt::format("{:.6g}", speed),
        fmt::format("basin and attractors take final speeds from -{0:g} to {0:g} critical speeds", fastest_speed));
  check_proof(study);
  reject_if_lacking(study, model::Answer::shares);
}

void check_proof(const Study& study) {
  if (study.numerics.decide != DecideMode::proof) return;
  if (const auto lack = model::lacking(study.system(), model::Answer::proofs))
    throw InputError(study.name, "numerics.decide", "proof", lack->reason + "; must be \"validated\" or \"horizon\"");
}

void check_offers(const Study& study, model::Answer answer) {
  check(study);
  reject_if_lacking(study, answer);
}

StartRunner::StartRunner(const Study& study, const DiscoverySettings& settings, bool transients)
    : study_(with_horizon(study)),
      stop_(settings.stop),
      system_(study.system()),
      transients_(transient_settings(study)),
      source_(make_spin_up(study_, settings.stop)),
      discovery_(discover(study_, settings)),
      catalogue_(discovery_.catalogue) {
  if (!transients) return;
  source_->watch(transients_);
  for (const Attractor& a : catalogue_.attractors()) {
    ends_.resize(std::max(ends_.size(), static_cast<std::size_t>(a.id) + 1));
    ends_[static_cast<std::size_t>(a.id)] = known_end(study_.parameters, a);
  }
}

// What the rule says of all starts that are not over yet: those that are keep their fates.
bool StartRunner::decide(SpunUp& starts, TransientTable* table, std::vector<Fate>& fates) const {
  const std::size_t size = system_.dimension();
  LaneTask task = source_->last_task();
  task.end = source_->settled() + *study_.numerics.horizon;
  task.stop = stop_;
  std::vector<std::size_t> places;
  std::vector<double> states, begins;
  TransientTable rows{transients_, {}, ends_};
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const double begin = starts.begin(i, source_->settled());
    if (starts.is_over(i) || !(begin < task.end)) continue;
    places.push_back(i);
    states.insert(states.end(), &starts.states[i * size], &starts.states[i * size] + size);
    begins.push_back(begin);
    if (table) rows.rows.push_back(table->rows[i]);
  }
  task.count = places.size();
  task.states = states.data();
  task.begins = begins.data();
  if (table) task.transients = &rows;
  std::vector<Fate> decided(places.size());
  if (!decide_lanes(task, discovery_.rule, decided, nullptr)) return false;
  fates = starts.fates;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const std::size_t i = places[k];
    fates[i] = decided[k];
    std::copy_n(&states[k * size], size, &starts.states[i * size]);
    if (table) table->rows[i] = rows.rows[k];
  }
  return true;
}

bool StartRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
                      std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  SpunUp starts;
  TransientTable table{transients_, {}, ends_};
  if (!source_->make(study_.sampling.seed, first, count, starts, rows ? &table : nullptr)) return false;
  if (!finish(starts, &table, fates, unlisted, rows)) return false;
  phi = starts.phi;
  return true;
}

bool StartRunner::run_from(std::span<const InitialState> given, std::vector<Fate>& fates,
                           std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  SpunUp starts;
  TransientTable table{transients_, {}, ends_};
  return source_->follow(parted(study_.parameters, given), starts, rows ? &table : nullptr) &&
         finish(starts, &table, fates, unlisted, rows);
}

// Decides starts and says what each came to; `table` is that of their transients so far, if `rows` are wanted.
bool StartRunner::finish(SpunUp& starts, TransientTable* table, std::vector<Fate>& fates,
                         std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  if (!decide(starts, rows ? table : nullptr, fates)) return false;
  if (!note_last_speeds(starts, fates)) return false;
  const std::size_t count = starts.size();
  unlisted.clear();
  if (rows) rows->assign(count, TransientRow{});
  for (std::size_t i = 0; i < count; ++i) {
    Fate& fate = fates[i];
    const bool attracted = fate.outcome == Outcome::attracted;
    std::optional<MotionFigures> end;
    if (attracted && fate.attractor == 0) {
      // A watched trajectory has gone on since it was decided.
      std::optional<UnlistedStart> start = unlisted_start(starts, i, rows ? table->rows[i].end : fate.time);
      if (!start) return false;
      unlisted.push_back(*std::move(start));
      fate.by = DecidedBy::followed;
      const auto& motion = unlisted.back().motion;
      if (motion && !system_.prescribed()) fate.mean_speed = static_cast<float>(motion->speed);
      if (motion && motion->set_valued) fate.unbalance = unbalance_at(motion->state.data());
      if (rows && motion && motion->stable) end = motion_figures(study_.parameters, *motion);
    } else if (attracted) {
      fate.mean_speed = static_cast<float>(mean_speed(fate));
      end = table->end_of(fate.attractor).figures;
    }
    if (attracted && fate.attractor > 0) note_unbalance(&starts.states[i * system_.dimension()], fate);
    if (attracted && stalls(fate)) fate.outcome = Outcome::stalled;
    if (!rows) continue;
    const bool lost = fate.outcome == Outcome::diverged || fate.outcome == Outcome::failed;
    (*rows)[i] = transient_row(settings_of(starts, i), table->rows[i], lost, end);
  }
  return true;
}

// Of starts whose fate the horizon left open. What runs away turns ever faster.
bool StartRunner::note_last_speeds(const SpunUp& starts, std::vector<Fate>& fates) const {
  if (system_.prescribed()) return true;
  const std::size_t size = system_.dimension();
  const LaneTask task = source_->last_task();
  const double horizon = source_->settled() + *study_.numerics.horizon;
  std::vector<std::size_t> places;
  std::vector<double> states;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (fates[i].outcome != Outcome::undecided || starts.is_over(i)) continue;
    const double* state = &starts.states[i * size];
    fates[i].mean_speed = static_cast<float>(state[task.places().speed]);
    if (fates[i].time < horizon) continue;
    places.push_back(i);
    states.insert(states.end(), state, state + size);
  }
  if (places.empty()) return true;
  const std::vector<double> speeds = mean_speeds_from(task, std::move(states), horizon);
  for (std::size_t k = 0; k < speeds.size(); ++k) fates[places[k]].mean_speed = static_cast<float>(speeds[k]);
  return !speeds.empty();
}

// Balls that dry friction holds leave each their own.
void StartRunner::note_unbalance(const double* state, Fate& fate) const {
  const Attractor* a = discovery_.catalogue.find(fate.attractor);
  if (a && a->motion.set_valued) fate.unbalance = unbalance_at(state);
}

float StartRunner::unbalance_at(const double* state) const {
  return static_cast<float>(std::abs(model::unbalance(study_.parameters, state + model::index::phi(0))));
}

// Of a driven rotor, its attractor's own: a trap may catch it before it has turned for long.
double StartRunner::mean_speed(const Fate& fate) const {
  const Attractor* a = system_.prescribed() || system_.coasts() ? nullptr : discovery_.catalogue.find(fate.attractor);
  return a ? a->motion.speed : fate.mean_speed;
}

// Whatever its motion is called: what the study's motor was to do it did not.
bool StartRunner::stalls(const Fate& fate) const {
  return !system_.prescribed() && std::fabs(fate.mean_speed) < study_.stall_speed();
}

// A motor lets go of each start's balls at a time of its own.
TransientSettings StartRunner::settings_of(const SpunUp& starts, std::size_t i) const {
  TransientSettings settings = transients_;
  if (!starts.released.empty()) settings.release = starts.released[i];
  return settings;
}

std::optional<UnlistedStart> StartRunner::unlisted_start(const SpunUp& starts, std::size_t i, double now) const {
  std::optional<UnlistedStart> start = follow(when_recognised(&starts.states[i * system_.dimension()], now));
  if (start) start->place = i;
  return start;
}

std::vector<UndecidedEnd> StartRunner::look_at(const std::vector<InitialState>& undecided) const {
  std::vector<UndecidedEnd> ends;
  for (const InitialState& given : undecided) {
    SpunUp start;
    std::vector<Fate> fates;
    if (!source_->follow(parted(study_.parameters, {&given, 1}), start)) break;
    if (start.is_over(0)) {
      ends.push_back({.what = Restlessness::held, .reached = start.nearest[0], .asked = *study_.release.speed});
      continue;
    }
    if (!decide(start, nullptr, fates)) break;
    const std::vector<double> z = when_recognised(start.states.data(), fates[0].time);
    const Eigen::Map<const Eigen::VectorXd> state(z.data(), static_cast<Eigen::Index>(z.size()));
    ends.push_back(look_at_undecided(system_, state));
    if (system_.prescribed()) continue;
    const float before = fates[0].mean_speed;
    if (!note_last_speeds(start, fates)) break;
    const double now = fates[0].mean_speed;
    const Restlessness of_rotor = restlessness(before, fates[0], start.begin(0, source_->settled()));
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
std::vector<double> StartRunner::when_recognised(const double* state, double now) const {
  const Eigen::Map<const Eigen::VectorXd> z(state, system_.dimension());
  std::vector<double> result(z.begin(), z.end());
  if (system_.section() != model::Section::strobe) return result;
  const auto at_strobe = at_next_strobe(system_, z, source_->last_task().segment.psi_at(now));
  if (at_strobe) result.assign(at_strobe->begin(), at_strobe->end());
  return result;
}

std::optional<UnlistedStart> StartRunner::follow(const std::vector<double>& state) const {
  const Eigen::Map<const Eigen::VectorXd> z(state.data(), static_cast<Eigen::Index>(state.size()));
  UnlistedStart start{0, state, motion_from(system_, z, motion_patience, stop_), {}};
  if (is_set(stop_)) return std::nullopt;  // its motion may have been cut short
  return start;
}

int StartRunner::list(const UnlistedStart& start) {
  const bool stable = start.motion && start.motion->stable;
  return stable ? catalogue_.add(study_.parameters, *start.motion) : 0;
}

}  // namespace equipoise
