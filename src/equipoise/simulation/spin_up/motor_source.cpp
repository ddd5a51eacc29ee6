// Takes driven rotors on lanes through their drive, first with balls clamped, then free.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "equipoise/machine/drives/full_state.hpp"
#include "equipoise/machine/mechanics/gravity_well.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/simulation/integrate/first_time.hpp"
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

// Follows `state` (machine/model/held_state.hpp) in double precision from `from` until the rotor reaches
// rule.release_speed, but at most to `to`. Empty if it does not reach it, or is lost. `state` ends at the returned
// time, else at `to`.
std::optional<double> find_release(const model::System& system, const ReleaseRule& rule, double from, double to,
                                   double* state) {
  using Flow = HWY_NAMESPACE::HeldFlow<double>;
  const int place = model::held_layout(system).speed;
  const auto come = [&](const double* y) {
    return rule.rising ? y[place] >= rule.release_speed : y[place] <= rule.release_speed;
  };
  HWY_NAMESPACE::ErrorScale<Flow::dimension> scale;
  scale.tolerance = 1e-10;  // only a step or two are taken, so a tight one costs nothing
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = system.parameters().motion_scale();
  scale.angle.fill(true);  // lanes detect divergence
  scale.absolute.fill(true);
  const Flow flow(system);
  HWY_NAMESPACE::AdaptiveIntegrator<Flow, Flow::dimension> integrator(flow, scale, flow.size());
  std::optional<double> found;
  const auto look = [&](double begin, double end, auto&& state_at) {
    double y[Flow::dimension];
    const auto first = first_time(begin, end, [&](double t) {
      state_at(t, y);
      return come(y);
    });
    if (!first) return end;
    found = first;  // the step is cut here, and the crossing is looked up again
    // The integrator stops only at times before the step's end.
    return std::fmin(*first, std::nextafter(end, begin));
  };
  integrator.advance(from, to, state, look);
  return found;
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

  double settled() const { return drive.pieces.back().begin; }
  OwnRotor rotor(std::size_t k) const {
    OwnRotor rotor = own_rotor(systems[k]);
    rotor.segment.begin = drive.pieces[k].begin;
    rotor.end = k + 1 < systems.size() ? drive.pieces[k].end : settled() + horizon;
    return rotor;
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
  bool own;                   // each has its own
  std::vector<char> clamped;  // of all starts
  std::size_t size;

  double* state(std::size_t i) const { return &starts.states[i * size]; }
  void let_go(std::size_t i, double time) {
    clamped[i] = 0;
    starts.released[i] = time;
  }
  template <class Wanted>
  std::vector<std::size_t> which(Wanted&& wanted) const {
    std::vector<std::size_t> result;
    for (const std::size_t i : members)
      if (!starts.is_over(i) && wanted(i)) result.push_back(i);
    return result;
  }
};

// Takes a start of a driven rotor from its index to its state in the last piece of the drive. Balls still clamped at
// the horizon are not followed further.
class MotorSource final : public SpinUp {
 public:
  MotorSource(const Study& study, const StopFlag* stop)
      : MotorSource(std::vector<Machine>{Machine(study)}, false, stop) {}

  bool follow(std::span<const InitialState> given, SpunUp& starts, TransientTable* transients) const override {
    std::vector<std::size_t> all(given.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    begin(
        given.size(), [&](std::size_t i) { return given[i]; }, starts, transients);
    return !is_set(stop_) && advance(all, starts, transients);
  }

  BatchTask last_task() const override { return task(machines_.front(), machines_.front().systems.size() - 1); }

  static bool follow_own_rotors(std::span<const OwnRotorStart> starts, const StopFlag* stop, SpunUp& spun,
                                TransientTable* transients) {
    using Shape = std::tuple<std::size_t, bool, bool, bool>;
    std::map<Shape, std::vector<std::size_t>> groups;
    std::vector<Machine> machines;
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Machine& m = machines.emplace_back(starts[i].study);
      groups[{m.systems.size(), m.clamped_at_first, m.drive.release_speed.has_value(), m.release_rule.rising}]
          .push_back(i);
      spun.rotors[i] = m.rotor(m.systems.size() - 1);
    }
    const MotorSource source(std::move(machines), true, stop);
    source.begin(
        starts.size(), [&](std::size_t i) { return starts[i].start; }, spun, transients);
    return std::all_of(groups.begin(), groups.end(), [&](const auto& group) {
      return !is_set(stop) && source.advance(group.second, spun, transients);
    });
  }

 private:
  MotorSource(std::vector<Machine> machines, bool own, const StopFlag* stop)
      : SpinUp(machines.front().study, stop), machines_(std::move(machines)), own_(own) {}

  const Machine& of(std::size_t i) const { return machines_[own_ ? i : 0]; }

  void add(const Machine& machine, const InitialState& start, SpunUp& starts) const {
    const model::System& system = machine.systems.front();
    starts.phi.insert(starts.phi.end(), start.phi.begin(), start.phi.begin() + system.balls());
    starts.states.resize(starts.states.size() + static_cast<std::size_t>(system.dimension()));
    double* state = &*starts.states.end() - system.dimension();
    initial_state(start, system.balls(), machine.drive.speed, state, system.layout().tilt);
    if (system.layout().psi >= 0) state[system.layout().psi] = start.psi;
    state[system.layout().speed] = machine.drive.speed;
    if (system.layout().error >= 0) state[system.layout().error] = 0.0;
  }

  template <class StartOf>
  void begin(std::size_t count, const StartOf& start_at, SpunUp& starts, TransientTable* transients) const {
    starts.phi.clear();
    starts.states.clear();
    for (std::size_t i = 0; i < count; ++i) add(of(i), start_at(i), starts);
    starts.begins.assign(count, 0.0);
    starts.released.assign(count, 0.0);
    starts.fates.assign(count, Fate{});
    starts.over.assign(count, 0);
    starts.nearest.resize(count);
    for (std::size_t i = 0; i < count; ++i) starts.nearest[i] = of(i).drive.speed;
    if (transients) transients->rows.assign(count, TransientSums{});
  }

  bool advance(const std::vector<std::size_t>& members, SpunUp& starts, TransientTable* transients) const {
    if (members.empty()) return true;
    const Machine& one = of(members.front());
    const auto size = static_cast<std::size_t>(one.systems.front().dimension());
    Fleet fleet{starts, transients, members, one, own_, std::vector<char>(starts.size(), one.clamped_at_first), size};
    for (std::size_t k = 0; k < one.drive.pieces.size(); ++k) {
      if (one.clamped_at_first && !follow_clamped(k, fleet)) return false;
      const bool last = k + 1 == one.drive.pieces.size();
      if (!last && !run_free(k, fleet)) return false;
      if (!last && transients)
        for (const std::size_t i : members) transients->rows[i].work.end_piece();
    }
    return true;
  }

  BatchTask task(const Machine& machine, std::size_t k) const {
    BatchTask task = batch_task(machine.systems[k]);
    task.segment.begin = machine.drive.pieces[k].begin;
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
      if (fleet.own) rule.own_speeds.push_back(of(i).release_rule.release_speed);
    if (!one.drive.release_speed || k + 1 < one.systems.size())
      rule.windows.first_long_window = std::numeric_limits<double>::infinity();
    else if (!fleet.own)  // the trapping region knows only one release speed
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

  // Runs these starts side by side over piece k; false if stopped early.
  template <class Run>
  bool side_by_side(std::size_t k, bool held, const std::vector<std::size_t>& places, std::vector<double>& states,
                    const Fleet& fleet, Run&& run) const {
    BatchTask task = this->task(fleet.one, k);
    if (held) task.end = until(places.front(), k);
    std::vector<double> begins;
    std::vector<OwnRotor> rotors;
    TransientTable table;
    if (fleet.transients) table = fleet.transients->part(places);
    for (const std::size_t i : places) {
      begins.push_back(fleet.starts.begins[i]);
      if (fleet.own) rotors.push_back(of(i).rotor(k));
      if (fleet.own && held) rotors.back().end = until(i, k);
    }
    const std::vector<const OwnRotor*> own = pointers_to(rotors);
    if (fleet.transients) task.transients = &table;
    task.held = held;
    task.take(states, own, begins);
    if (!run(task)) return false;
    if (fleet.transients) fleet.transients->put_back(places, table);
    return true;
  }

  // Follows clamped balls over piece k of the drive, until their release.
  bool follow_clamped(std::size_t k, Fleet& fleet) const {
    const std::size_t size = model::held_layout(fleet.one.systems[k]).size;
    SpunUp& starts = fleet.starts;
    for (;;) {
      const auto places =
          fleet.which([&](std::size_t i) { return fleet.clamped[i] && starts.begins[i] < until(i, k); });
      if (places.empty()) break;
      const ReleaseRule rule = rule_over(k, places, fleet);
      std::vector<double> states(places.size() * size);
      for (std::size_t j = 0; j < places.size(); ++j)
        model::hold_balls(of(places[j]).systems[k], fleet.state(places[j]), &states[j * size]);
      std::vector<ClampedEnd> ends(places.size());
      if (!side_by_side(k, true, places, states, fleet,
                        [&](BatchTask& task) { return follow_clamped_batch(task, rule, ends); }))
        return false;
      for (std::size_t j = 0; j < places.size(); ++j) end_clamped(k, places[j], ends[j], &states[j * size], fleet);
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
    double now = end.fate.time;
    if (end.crossing) {
      const auto release = find_release(m.systems[k], rule, now, end.crossed_by, state);
      now = release.value_or(end.crossed_by);
      if (release) fleet.let_go(i, now);
    }
    starts.begins[i] = now;
    starts.nearest[i] = end.nearest;
    model::release_balls(m.systems[k], state, fleet.state(i));
    if (end.crossing) return;
    Fate fate = end.fate;
    const bool to_the_end = fate.outcome == Outcome::undecided && now >= until(i, k);
    if (to_the_end && until(i, k) < m.settled() + m.horizon) return;
    const bool may_come = std::fabs(end.nearest - rule.release_speed) < nearly_let_go * std::fabs(rule.release_speed);
    const bool hangs = fate.by == DecidedBy::validated;
    if (fate.outcome == Outcome::attracted && may_come && !hangs) return;  // goes on with new windows
    const bool steady_now = fate.outcome == Outcome::attracted || rule.windows.at_horizon;
    if (hangs) fate.mean_speed = 0.0F;
    // A window of the run-up has the mean speed of its time, not the last one.
    if (to_the_end) fate.mean_speed = static_cast<float>(fleet.state(i)[m.systems[k].layout().speed]);
    const bool slow = std::fabs(fate.mean_speed) < m.study.stall_speed();
    if (fate.outcome == Outcome::attracted) fate.outcome = Outcome::undecided;
    if (fate.outcome == Outcome::undecided && steady_now && slow) fate.outcome = Outcome::stalled;
    fate.by = fate.outcome != Outcome::stalled ? DecidedBy::nothing : to_the_end ? DecidedBy::horizon : end.fate.by;
    starts.fates[i] = fate;
    starts.over[i] = 1;
  }

  // Follows free balls over piece k of the drive, not the last.
  bool run_free(std::size_t k, Fleet& fleet) const {
    SpunUp& starts = fleet.starts;
    const auto end = [&](std::size_t i) { return of(i).drive.pieces[k].end; };
    const auto places = fleet.which([&](std::size_t i) { return !fleet.clamped[i] && starts.begins[i] < end(i); });
    if (places.empty()) return true;
    std::vector<double> states;
    std::vector<Fate> fates(places.size());
    for (std::size_t j = 0; j < places.size(); ++j) {
      const double* state = fleet.state(places[j]);
      states.insert(states.end(), state, state + fleet.size);
      fates[j].met = starts.fates[places[j]].met;
    }
    if (!side_by_side(k, false, places, states, fleet, [&](BatchTask& task) { return advance_batch(task, fates); }))
      return false;
    for (std::size_t j = 0; j < places.size(); ++j) {
      const std::size_t i = places[j];
      std::copy_n(&states[j * fleet.size], fleet.size, fleet.state(i));
      starts.begins[i] = end(i);
      starts.fates[i] = fates[j];
    }
    return true;
  }

  std::vector<Machine> machines_;
  bool own_;  // each start has its own machine, else all share one
};

}  // namespace

SpinUp::SpinUp(const Study& study, const StopFlag* stop) : study_(study), sampler_(sampler_of(study)), stop_(stop) {}

bool SpinUp::make(std::uint64_t seed, std::uint64_t first, std::size_t count, SpunUp& starts,
                  TransientTable* transients) const {
  return follow(starts_of(study_, sampler_, seed, first, count), starts, transients);
}

bool spin_up_motors(std::span<const OwnRotorStart> starts, const StopFlag* stop, SpunUp& spun,
                    TransientTable* transients) {
  return MotorSource::follow_own_rotors(starts, stop, spun, transients);
}

std::unique_ptr<SpinUp> make_spin_up(const Study& study, const StopFlag* stop) {
  if (study.speed.driven()) return std::make_unique<MotorSource>(study, stop);
  return std::make_unique<StartSource>(study, stop);
}

}  // namespace equipoise
