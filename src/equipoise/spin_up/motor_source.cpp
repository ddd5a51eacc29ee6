// Driven rotors on lanes: their balls held, each start on its own way, and free.
#include "equipoise/spin_up/motor_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/base/stop_flag.hpp"
#include "equipoise/kernels/lane_kernels.hpp"
#include "equipoise/model/gravity_well.hpp"
#include "equipoise/model/held_state.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/spin_up/release.hpp"
#include "equipoise/spin_up/start_source.hpp"

namespace equipoise {

namespace {

// Held balls and a rotor are a damped oscillator with a motor: windows of its speed that differ by less, each twice as
// long as the one before, approach what they come to.
constexpr double steady = 1e-3;
// The motion, in the rule's words, of a rotor that never lets its balls go.
constexpr int held_for_good = 1;
// A speed that comes this near to the one at which balls are let go, as a share of it, may reach it yet.
constexpr double nearly_let_go = 1e-3;

HoldRule hold_rule(const model::Parameters& p, const model::Drive& drive) {
  HoldRule rule;
  rule.windows.balls = 1;  // one body
  rule.windows.sameness = steady;
  rule.windows.repeats_needed = 1;
  rule.windows.sag = model::static_sag(p);
  if (!drive.release_speed) return rule;
  rule.release_speed = *drive.release_speed;
  rule.rising = rule.release_speed > drive.speed;
  return rule;
}

}  // namespace

// Starts on their way.
struct MotorSource::Fleet {
  SpunUp& starts;
  TransientTable* transients;
  std::vector<char> held;
  std::size_t size;

  double* state(std::size_t i) const { return &starts.states[i * size]; }
  void let_go(std::size_t i, double time) {
    held[i] = 0;
    starts.released[i] = time;
  }
  // Those of which `wanted` holds and which are not over.
  template <class Wanted>
  std::vector<std::size_t> which(Wanted&& wanted) const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < held.size(); ++i)
      if (!starts.is_over(i) && wanted(i)) result.push_back(i);
    return result;
  }
  // A table with the rows of these alone, and back.
  TransientTable rows_of(const std::vector<std::size_t>& places) const {
    TransientTable table{transients->settings, {}, transients->ends};
    for (const std::size_t i : places) table.rows.push_back(transients->rows[i]);
    return table;
  }
  void put_rows(const std::vector<std::size_t>& places, const TransientTable& table) const {
    for (std::size_t k = 0; k < places.size(); ++k) transients->rows[places[k]] = table.rows[k];
  }
};

MotorSource::MotorSource(const Study& study, const StopFlag* stop)
    : study_(study),
      sampler_(sampler_of(study)),
      stop_(stop),
      drive_(study.drive()),
      hold_(hold_rule(study.parameters, drive_)),
      held_at_first_(drive_.release_time > 0.0 && !(drive_.release_speed && *drive_.release_speed == drive_.speed)),
      horizon_(*study.numerics.horizon),
      tolerance_(study.numerics.tolerance.value_or(default_basin_tolerance)) {
  for (const model::DrivePiece& piece : drive_.pieces) systems_.emplace_back(study.parameters, piece);
  if (study.numerics.decide == DecideMode::horizon) hold_.windows.at_horizon = true;
}

void MotorSource::add(const InitialState& start, SpunUp& starts) const {
  const model::System& system = systems_.front();
  starts.phi.insert(starts.phi.end(), start.phi.begin(), start.phi.begin() + system.balls());
  starts.states.resize(starts.states.size() + static_cast<std::size_t>(system.dimension()));
  double* state = &*starts.states.end() - system.dimension();
  initial_state(start, system.balls(), drive_.speed, state);
  if (system.psi_place() >= 0) state[system.psi_place()] = start.psi;
  state[system.speed_place()] = drive_.speed;
  if (system.error_place() >= 0) state[system.error_place()] = 0.0;
}

bool MotorSource::make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                       TransientTable* transients) const {
  return follow(starts_of(study_, sampler_, seed, first, count), starts, transients);
}

bool MotorSource::follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients) const {
  starts.phi.clear();
  starts.states.clear();
  for (const InitialState& start : given) add(start, starts);
  return !is_set(stop_) && advance(starts, transients);
}

// From time 0 to where states are wanted.
bool MotorSource::advance(SpunUp& starts, TransientTable* transients) const {
  const std::size_t size = systems_.front().dimension(), count = starts.states.size() / size;
  starts.begins.assign(count, 0.0);
  starts.released.assign(count, 0.0);
  starts.fates.assign(count, Fate{});
  starts.over.assign(count, 0);
  starts.nearest.assign(count, drive_.speed);
  if (transients) transients->rows.assign(count, TransientSums{});
  Fleet fleet{starts, transients, std::vector<char>(count, held_at_first_), size};
  for (std::size_t k = 0; k < drive_.pieces.size(); ++k) {
    if (held_at_first_ && !hold(k, fleet)) return false;
    const bool last = k + 1 == drive_.pieces.size();
    if (!last && !run_free(k, fleet)) return false;
    if (!last && transients)
      for (TransientSums& row : transients->rows) row.work.end_piece();
  }
  return true;
}

LaneTask MotorSource::task(std::size_t k) const {
  LaneTask task = lane_task(systems_[k]);
  task.segment.begin = drive_.pieces[k].begin;
  task.end = drive_.pieces[k].end;
  task.tolerance = tolerance_;
  task.stop = stop_;
  return task;
}

LaneTask MotorSource::last_task() const { return task(systems_.size() - 1); }

// Where a time lets the balls go, or the torque still changes, a rotor that is steady is no end.
HoldRule MotorSource::rule_over(std::size_t k) const {
  HoldRule rule = hold_;
  if (!drive_.release_speed || k + 1 < systems_.size())
    rule.windows.first_long_window = std::numeric_limits<double>::infinity();
  else
    rule.windows.strobed = {[system = systems_[k], speed = rule.release_speed](const double* held, double) {
      return model::held_in_well(system, held, speed) ? held_for_good : 0;
    }};
  return rule;
}

// Held balls over piece k of the drive, until they are let go.
bool MotorSource::hold(std::size_t k, Fleet& fleet) const {
  const model::System& system = systems_[k];
  const std::size_t size = model::held_dimension(system);
  const double until = std::min({drive_.pieces[k].end, drive_.release_time, settled() + horizon_});
  const HoldRule rule = rule_over(k);
  SpunUp& starts = fleet.starts;
  for (;;) {
    const auto places = fleet.which([&](std::size_t i) { return fleet.held[i] && starts.begins[i] < until; });
    if (places.empty()) break;
    std::vector<double> states(places.size() * size), begins;
    for (std::size_t j = 0; j < places.size(); ++j) {
      model::hold_balls(system, fleet.state(places[j]), &states[j * size]);
      begins.push_back(starts.begins[places[j]]);
    }
    LaneTask held = task(k);
    held.end = until;
    held.count = places.size();
    held.states = states.data();
    held.begins = begins.data();
    held.held = true;
    TransientTable rows;
    if (fleet.transients) rows = fleet.rows_of(places);
    if (fleet.transients) held.transients = &rows;
    std::vector<HeldEnd> ends(places.size());
    if (!hold_lanes(held, rule, ends)) return false;
    if (fleet.transients) fleet.put_rows(places, rows);
    for (std::size_t j = 0; j < places.size(); ++j) end_hold(k, places[j], ends[j], until, &states[j * size], fleet);
  }
  // Balls whose time of release is the end of this piece, or was.
  for (const std::size_t i : fleet.which([&](std::size_t i) { return fleet.held[i] != 0; }))
    if (starts.begins[i] >= drive_.release_time) fleet.let_go(i, starts.begins[i]);
  return true;
}

void MotorSource::end_hold(std::size_t k, std::size_t i, const HeldEnd& end, double until, double* state,
                           Fleet& fleet) const {
  SpunUp& starts = fleet.starts;
  double now = end.fate.time;
  if (end.crossing) {
    const auto release = find_release(systems_[k], hold_, now, end.crossed_by, state);
    now = release.value_or(end.crossed_by);
    if (release) fleet.let_go(i, now);
  }
  starts.begins[i] = now;
  starts.nearest[i] = end.nearest;
  model::release_balls(systems_[k], state, fleet.state(i));
  if (end.crossing) return;
  Fate fate = end.fate;
  const bool to_the_end = fate.outcome == Outcome::undecided && now >= until;
  if (to_the_end && until < settled() + horizon_) return;
  const bool may_come = std::fabs(end.nearest - hold_.release_speed) < nearly_let_go * std::fabs(hold_.release_speed);
  const bool hangs = fate.by == DecidedBy::validated;                    // for good
  if (fate.outcome == Outcome::attracted && may_come && !hangs) return;  // goes on, with new windows
  const bool steady_now = fate.outcome == Outcome::attracted || hold_.windows.at_horizon;
  if (hangs) fate.mean_speed = 0.0F;
  // A window of the run-up tells how fast it turned then.
  if (to_the_end) fate.mean_speed = static_cast<float>(fleet.state(i)[systems_[k].places().speed]);
  const bool slow = std::fabs(fate.mean_speed) < study_.stall_speed();
  if (fate.outcome == Outcome::attracted) fate.outcome = Outcome::undecided;
  if (fate.outcome == Outcome::undecided && steady_now && slow) fate.outcome = Outcome::stalled;
  fate.by = fate.outcome != Outcome::stalled ? DecidedBy::nothing : to_the_end ? DecidedBy::horizon : end.fate.by;
  starts.fates[i] = fate;
  starts.over[i] = 1;
}

// Free balls over piece k of the drive, which is not the last.
bool MotorSource::run_free(std::size_t k, Fleet& fleet) const {
  SpunUp& starts = fleet.starts;
  const double end = drive_.pieces[k].end;
  const auto places = fleet.which([&](std::size_t i) { return !fleet.held[i] && starts.begins[i] < end; });
  if (places.empty()) return true;
  std::vector<double> states, begins;
  for (const std::size_t i : places) {
    states.insert(states.end(), fleet.state(i), fleet.state(i) + fleet.size);
    begins.push_back(starts.begins[i]);
  }
  LaneTask free = task(k);
  free.count = places.size();
  free.states = states.data();
  free.begins = begins.data();
  TransientTable rows;
  if (fleet.transients) rows = fleet.rows_of(places);
  if (fleet.transients) free.transients = &rows;
  std::vector<Fate> fates(places.size());
  if (!advance_lanes(free, fates)) return false;
  if (fleet.transients) fleet.put_rows(places, rows);
  for (std::size_t j = 0; j < places.size(); ++j) {
    const std::size_t i = places[j];
    std::copy_n(&states[j * fleet.size], fleet.size, fleet.state(i));
    starts.begins[i] = end;
    starts.fates[i] = fates[j];
  }
  return true;
}

std::unique_ptr<SpinUp> make_spin_up(const Study& study, const StopFlag* stop) {
  if (study.speed.driven()) return std::make_unique<MotorSource>(study, stop);
  return std::make_unique<StartSource>(study, stop);
}

}  // namespace equipoise
