// Takes rotors on lanes through their drive piece by piece, first with balls clamped, then free: starts that share a
// driven rotor, and starts that have rotors of their own.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/mechanics/frames.hpp"
#include "equipoise/machine/mechanics/gravity_well.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/integrate/clamped.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/rule/classification_rule.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"
#include "equipoise/simulation/spin_up/spin_up.hpp"
#include "equipoise/simulation/spin_up/start_source.hpp"

namespace equipoise {

namespace {

// A rotor with clamped balls is steady once its speeds in windows, each twice as long as the last, differ by less.
constexpr double steady = 1e-3;
// The rule's identifier for the motion of a rotor that never releases its balls.
constexpr int clamped_for_good = 1;
// A speed this close to the release speed, relatively, may still reach it.
constexpr double nearly_let_go = 1e-3;

ReleaseRule release_rule_of(const model::Parameters& p, const model::Drive& drive) {
  ReleaseRule rule;
  rule.windows.balls = 1;  // rotor and balls are one body
  rule.windows.sameness = steady;
  rule.windows.repeats_needed = 1;
  rule.windows.sag = model::static_sag(p);
  if (!drive.release_speed) return rule;
  rule.release_speed = *drive.release_speed;
  rule.rising = rule.release_speed > drive.speed;
  return rule;
}

struct Machine {
  explicit Machine(const Study& given)
      : study(given),
        drive(study.drive()),
        release_rule(release_rule_of(study.parameters, drive)),
        clamped_at_first(drive.release_time > 0.0 && !(drive.release_speed && *drive.release_speed == drive.speed)),
        horizon(*study.numerics.horizon) {
    for (const model::DrivePiece& piece : drive.pieces) systems.emplace_back(study.parameters, piece);
    if (study.numerics.decide == ClassificationMode::horizon) release_rule.windows.at_horizon = true;
  }

  bool prescribed() const { return drive.pieces.front().prescribed; }
  double settled() const { return drive.pieces.back().begin; }
  model::Segment segment(std::size_t k) const {
    const model::DrivePiece& piece = drive.pieces[k];
    if (piece.prescribed) return piece.motion(piece.begin < drive.release_time);
    return {piece.begin, 1e300, 0.0, piece.speed, 0.0, false};
  }
  OwnRotor rotor(std::size_t k) const {
    return {systems[k], segment(k), k + 1 < systems.size() ? drive.pieces[k].end : settled() + horizon};
  }
  // Starts of one shape run side by side.
  auto shape() const {
    const auto held = std::count_if(drive.pieces.begin(), drive.pieces.end(), [&](const model::DrivePiece& piece) {
      return piece.prescribed && piece.begin < drive.release_time;
    });
    return std::tuple(systems.size(), held, clamped_at_first, drive.release_speed.has_value(), release_rule.rising);
  }
  // Takes a state at the end of piece k, not the last, into the next.
  void cross(std::size_t k, double* state) const {
    if (!prescribed()) return;
    const double jump = drive.pieces[k + 1].speed - segment(k).speed_at(drive.pieces[k].end);
    model::apply_speed_jump(jump, state, systems[k].layout().tilt);
  }
  // Whether the release alone separates piece k from the next.
  bool goes_on(std::size_t k) const {
    return prescribed() && drive.pieces[k].acceleration == drive.pieces[k + 1].acceleration;
  }

  Study study;
  model::Drive drive;
  std::vector<model::System> systems;  // over each piece
  ReleaseRule release_rule;
  bool clamped_at_first;
  double horizon;
};

// Starts that run side by side: their drives have the same pieces.
struct Fleet {
  SpunUp& starts;
  TransientTable* transients;
  const std::vector<std::size_t>& members;
  const Machine& one;         // the first member's
  std::vector<char> clamped;  // of all starts

  double* state(std::size_t i) const { return &starts.states[i * one.systems.front().dimension()]; }
  void let_go(std::size_t i, double time) {
    clamped[i] = 0;
    if (!starts.released.empty()) starts.released[i] = time;
  }
  template <class Wanted>
  std::vector<std::size_t> which(Wanted&& wanted) const {
    std::vector<std::size_t> result;
    for (const std::size_t i : members)
      if (!starts.is_over(i) && wanted(i)) result.push_back(i);
    return result;
  }
};

// Takes starts to their states in the last piece of the drive. Balls of a driven rotor that are still clamped at the
// horizon are not followed further.
class FleetSource final : public SpinUp {
 public:
  // Of one driven rotor.
  FleetSource(const Study& study, const StopFlag* stop)
      : FleetSource(std::vector<Machine>{Machine(study)}, false, stop) {}

  bool follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients) const override {
    std::vector<std::size_t> all(given.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    begin(
        given.size(), [&](std::size_t i) { return given[i]; }, starts, transients);
    return !is_set(stop_) && advance(all, starts, transients);
  }

  BatchTask last_task() const override { return task(machines_.front(), machines_.front().systems.size() - 1); }

  static bool follow_own_rotors(std::span<const OwnRotorStart> given, const StopFlag* stop, SpunUp& starts,
                                TransientTable* transients) {
    std::map<decltype(std::declval<Machine>().shape()), std::vector<std::size_t>> groups;
    std::vector<Machine> machines;
    machines.reserve(given.size());
    starts.rotors.reserve(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Machine& m = machines.emplace_back(given[i].study);
      groups[m.shape()].push_back(i);
      starts.rotors.push_back(m.rotor(m.systems.size() - 1));
    }
    const FleetSource source(std::move(machines), true, stop);
    source.begin(
        given.size(), [&](std::size_t i) { return given[i].start; }, starts, transients);
    return std::all_of(groups.begin(), groups.end(), [&](const auto& group) {
      if (is_set(stop)) return false;
      const Machine& one = source.of(group.second.front());
      const bool alone = one.prescribed() && one.clamped_at_first && (transients || one.systems.front().tilts());
      return alone ? source.follow_each(given, group.second, starts, transients)
                   : source.advance(group.second, starts, transients);
    });
  }

 private:
  FleetSource(std::vector<Machine> machines, bool own, const StopFlag* stop)
      : SpinUp(machines.front().study, stop), machines_(std::move(machines)), own_(own) {}

  const Machine& of(std::size_t i) const { return machines_[own_ ? i : 0]; }

  void add(const Machine& machine, const InitialState& start, SpunUp& starts) const {
    const model::System& system = machine.systems.front();
    starts.phi.insert(starts.phi.end(), start.phi.begin(), start.phi.begin() + system.balls());
    starts.states.resize(starts.states.size() + static_cast<std::size_t>(system.dimension()));
    double* state = &*starts.states.end() - system.dimension();
    initial_state(start, system.balls(), machine.drive.speed, state, system.layout().tilt);
    if (system.layout().psi >= 0) state[system.layout().psi] = start.psi;
    if (system.layout().speed >= 0) state[system.layout().speed] = machine.drive.speed;
    if (system.layout().error >= 0) state[system.layout().error] = 0.0;
  }

  template <class StartOf>
  void begin(std::size_t count, const StartOf& start_at, SpunUp& starts, TransientTable* transients) const {
    starts.phi.clear();
    starts.states.clear();
    for (std::size_t i = 0; i < count; ++i) add(of(i), start_at(i), starts);
    starts.begins.assign(count, 0.0);
    starts.outcomes.assign(count, Outcome{});
    if (transients) transients->rows.assign(count, TransientSums{});
    if (of(0).prescribed()) return;
    starts.released.assign(count, 0.0);
    starts.over.assign(count, 0);
    starts.nearest.resize(count);
    for (std::size_t i = 0; i < count; ++i) starts.nearest[i] = of(i).drive.speed;
  }

  // One rotor after the other: at a prescribed speed transients of held balls come from superposition, and held balls
  // also load a tilting rotor by a couple.
  bool follow_each(std::span<const OwnRotorStart> given, const std::vector<std::size_t>& members, SpunUp& starts,
                   TransientTable* transients) const {
    for (const std::size_t i : members) {
      StartSource source(given[i].study, stop_);
      TransientTable table;
      if (transients) table.settings = transients->own[i];
      if (transients) source.watch(table.settings);
      SpunUp one;
      if (!source.follow({&given[i].start, 1}, one, transients ? &table : nullptr)) return false;
      std::copy(one.states.begin(), one.states.end(), &starts.states[i * one.states.size()]);
      starts.outcomes[i] = one.outcomes.front();
      starts.begins[i] = of(i).settled();
      if (transients) transients->rows[i] = table.rows.front();
    }
    return true;
  }

  bool advance(const std::vector<std::size_t>& members, SpunUp& starts, TransientTable* transients) const {
    if (members.empty()) return true;
    const Machine& one = of(members.front());
    Fleet fleet{starts, transients, members, one, std::vector<char>(starts.size(), one.clamped_at_first)};
    for (std::size_t k = 0; k < one.drive.pieces.size(); ++k) {
      if (one.clamped_at_first && !follow_clamped(k, fleet)) return false;
      if (k + 1 == one.drive.pieces.size()) break;
      const auto free =
          fleet.which([&](std::size_t i) { return !fleet.clamped[i] && starts.begins[i] < of(i).drive.pieces[k].end; });
      if (!free.empty() && !finish_piece(k, false, free, fleet)) return false;
      for (const std::size_t i : members) {
        of(i).cross(k, fleet.state(i));
        if (transients && !of(i).goes_on(k)) transients->rows[i].work.end_piece();
      }
    }
    return true;
  }

  BatchTask task(const Machine& machine, std::size_t k) const {
    BatchTask task = batch_task(machine.systems[k]);
    task.segment = machine.segment(k);
    task.end = machine.drive.pieces[k].end;
    task.tolerance = machine.study.numerics.tolerance.value_or(default_basin_tolerance);
    task.stop = stop_;
    return task;
  }

  // While the release time or a change of torque is still to come, a steady rotor is no end.
  ReleaseRule rule_over(std::size_t k, const std::vector<std::size_t>& places, const Fleet& fleet) const {
    const Machine& one = fleet.one;
    ReleaseRule rule = one.release_rule;
    for (const std::size_t i : places)
      if (own_) rule.own_speeds.push_back(of(i).release_rule.release_speed);
    if (!one.drive.release_speed || k + 1 < one.systems.size())
      rule.windows.first_long_window = std::numeric_limits<double>::infinity();
    else if (!own_)  // the trapping region knows only one release speed
      rule.windows.section.regions = regions_by(
          [system = one.systems[k], speed = rule.release_speed](const double* held, double, const OwnRotor*) -> Caught {
            return {model::trapped_in_well(system, held, speed) ? clamped_for_good : 0};
          });
    return rule;
  }

  double until(std::size_t i, std::size_t k) const {
    const Machine& m = of(i);
    return std::min({m.drive.pieces[k].end, m.drive.release_time, m.settled() + m.horizon});
  }

  // Runs these starts side by side over piece k, and calls end(j, state) for each in the order of `places`. False if
  // stopped early.
  template <class Run, class End>
  bool side_by_side(std::size_t k, bool held, const std::vector<std::size_t>& places, const Fleet& fleet, Run&& run,
                    End&& end) const {
    BatchTask task = this->task(fleet.one, k);
    task.held = held;
    if (held) task.system = &fleet.one.systems[k];
    const auto size = static_cast<std::size_t>(task.dimension());
    std::vector<double> states(places.size() * size);
    // Clamped balls at a prescribed speed cost little to follow, and the state at release decides much.
    constexpr double held_tolerance = 1e-3;
    if (held && fleet.one.prescribed()) task.tolerance *= held_tolerance;
    if (held) task.end = until(places.front(), k);
    std::vector<double> begins;
    std::vector<OwnRotor> rotors;
    TransientTable table;
    if (fleet.transients) table = fleet.transients->part(places);
    for (std::size_t j = 0; j < places.size(); ++j) {
      const std::size_t i = places[j];
      if (held)
        model::hold_balls(of(i).systems[k], fleet.state(i), &states[j * size]);
      else
        std::copy_n(fleet.state(i), size, &states[j * size]);
      begins.push_back(fleet.starts.begins[i]);
      if (own_) rotors.push_back(of(i).rotor(k));
      if (own_ && held) rotors.back().end = until(i, k);
    }
    const std::vector<const OwnRotor*> own = pointers_to(rotors);
    if (fleet.transients) task.transients = &table;
    task.take(states, own, begins);
    if (!run(task)) return false;
    if (fleet.transients) fleet.transients->put_back(places, table);
    for (std::size_t j = 0; j < places.size(); ++j) end(j, &states[j * size]);
    return true;
  }

  // Takes these starts to the end of piece k, where those that are not lost arrive.
  bool finish_piece(std::size_t k, bool held, const std::vector<std::size_t>& places, const Fleet& fleet) const {
    std::vector<Outcome> outcomes(places.size());
    for (std::size_t j = 0; j < places.size(); ++j) outcomes[j].met = fleet.starts.outcomes[places[j]].met;
    return side_by_side(
        k, held, places, fleet, [&](BatchTask& task) { return advance_batch(task, outcomes); },
        [&](std::size_t j, const double* state) {
          const std::size_t i = places[j];
          if (held)
            model::release_balls(of(i).systems[k], state, fleet.state(i));
          else
            std::copy_n(state, of(i).systems[k].dimension(), fleet.state(i));
          fleet.starts.begins[i] = of(i).drive.pieces[k].end;
          fleet.starts.outcomes[i] = outcomes[j];
        });
  }

  // Follows clamped balls over piece k of the drive, until their release.
  bool follow_clamped(std::size_t k, Fleet& fleet) const {
    SpunUp& starts = fleet.starts;
    for (;;) {
      const auto places =
          fleet.which([&](std::size_t i) { return fleet.clamped[i] && starts.begins[i] < until(i, k); });
      if (places.empty()) break;
      if (fleet.one.prescribed()) {
        if (!finish_piece(k, true, places, fleet)) return false;
        continue;
      }
      const ReleaseRule rule = rule_over(k, places, fleet);
      std::vector<ClampedEnd> ends(places.size());
      if (!side_by_side(
              k, true, places, fleet, [&](BatchTask& task) { return follow_clamped_batch(task, rule, ends); },
              [&](std::size_t j, double* state) { end_clamped(k, places[j], ends[j], state, fleet); }))
        return false;
    }
    // Releases balls whose release time comes by the end of this piece.
    for (const std::size_t i : fleet.which([&](std::size_t i) { return fleet.clamped[i] != 0; }))
      if (starts.begins[i] >= of(i).drive.release_time) fleet.let_go(i, starts.begins[i]);
    return true;
  }

  void end_clamped(std::size_t k, std::size_t i, const ClampedEnd& end, double* state, Fleet& fleet) const {
    SpunUp& starts = fleet.starts;
    const Machine& m = of(i);
    const ReleaseRule& rule = m.release_rule;
    double now = end.outcome.time;
    if (end.crossing) {
      const auto release = find_release(m.systems[k], rule.release_speed, rule.rising, now, end.crossed_by, state);
      now = release.value_or(end.crossed_by);
      if (release) fleet.let_go(i, now);
    }
    starts.begins[i] = now;
    starts.nearest[i] = end.nearest;
    model::release_balls(m.systems[k], state, fleet.state(i));
    if (end.crossing) return;
    Outcome outcome = end.outcome;
    const bool to_the_end = outcome.kind == OutcomeKind::undecided && now >= until(i, k);
    if (to_the_end && until(i, k) < m.settled() + m.horizon) return;
    const bool may_come = std::fabs(end.nearest - rule.release_speed) < nearly_let_go * std::fabs(rule.release_speed);
    const bool hangs = outcome.by == DecidedBy::validated;
    if (outcome.kind == OutcomeKind::attracted && may_come && !hangs) return;  // goes on with new windows
    const bool steady_now = outcome.kind == OutcomeKind::attracted || rule.windows.at_horizon;
    if (hangs) outcome.mean_speed = 0.0F;
    // A window of the run-up has the mean speed of its time, not the last one.
    if (to_the_end) outcome.mean_speed = static_cast<float>(fleet.state(i)[m.systems[k].layout().speed]);
    const bool slow = std::fabs(outcome.mean_speed) < m.study.stall_speed();
    if (outcome.kind == OutcomeKind::attracted) outcome.kind = OutcomeKind::undecided;
    if (outcome.kind == OutcomeKind::undecided && steady_now && slow) outcome.kind = OutcomeKind::stalled;
    outcome.by = outcome.kind != OutcomeKind::stalled ? DecidedBy::nothing
                 : to_the_end                         ? DecidedBy::horizon
                                                      : end.outcome.by;
    starts.outcomes[i] = outcome;
    starts.over[i] = 1;
  }

  std::vector<Machine> machines_;
  bool own_;  // each start has its own machine, else all share one
};

}  // namespace

std::unique_ptr<SpinUp> make_spin_up(const Study& study, const StopFlag* stop) {
  if (study.speed.driven()) return std::make_unique<FleetSource>(study, stop);
  return std::make_unique<StartSource>(study, stop);
}

bool spin_up_own_rotors(std::span<const OwnRotorStart> given, const StopFlag* stop, SpunUp& starts,
                        TransientTable* transients) {
  starts = {};
  return given.empty() || FleetSource::follow_own_rotors(given, stop, starts, transients);
}

}  // namespace equipoise
