// One machine trajectory after the other.
#include "equipoise/fates/machine_runner.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "equipoise/discovery/cost.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/last_speed.hpp"
#include "equipoise/fates/machine_scale.hpp"
#include "equipoise/fates/start_runner.hpp"
#include "equipoise/fates/transient_tally.hpp"
#include "equipoise/integrate/machine_trajectory-inl.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/spin_up/initial_state.hpp"
#include "equipoise/transients/transient_watch.hpp"

namespace equipoise {

namespace {
namespace kernels = HWY_NAMESPACE;
using Machine = kernels::MachineTrajectory<model::any_count>;

// Of a step, where it is looked at.
constexpr auto& nodes = TransientWatch::nodes;

// Distance from where gravity alone would hold the rotor with its balls.
SteadySample sample(const model::Parameters& p, const double* z) {
  const int n = p.balls;
  const std::array<double, 2> rest = model::rest_position(p, z[model::machine_index::psi(n)]);
  const double x = z[model::index::x] - rest[0], y = z[model::index::y] - rest[1];
  SteadySample s;
  s.r2 = x * x + y * y;
  for (int i = 0; i < n; ++i) {
    s.phi[i] = z[model::index::phi(i)];
    s.rate[i] = z[model::index::q(i, n)];
  }
  return s;
}

// The transients of one machine, whose balls are let go at a time of its own.
class MachineTransients {
 public:
  MachineTransients(const Study& study, const Machine& machine)
      : p_(study.parameters), settings_(transient_settings(study)), machine_(machine), watch_(settings(machine)) {
    if (study.speed.driven()) motor_ = model::drive_segments(study.motor());
  }

  // A step, of which state_at is asked.
  template <class StateAt>
  void step(double from, double to, StateAt&& state_at) {
    double z[Machine::dimension];
    state_at.roughly(from, z);
    while (piece_ + 1 < motor_.size() && motor_[piece_].end <= from) {
      ++piece_;
      watch_.end_piece();
    }
    // Wherever the motion has a corner, speeds or forces may have jumped.
    if (events_ != machine_.events() || from != last_) {
      if (events_ != machine_.events() && free_ == machine_.clamped()) {
        watch_ = TransientWatch(settings(machine_), watch_.sums());
        free_ = !machine_.clamped();
      }
      events_ = machine_.events();
      watch_.begin(sample_of(from, z), free_);
    }
    watch_.step_to(to, [&](double t) {
      state_at.roughly(t, z);
      return sample_of(t, z);
    });
    last_ = to;
  }

  void decided(bool balanced) { watch_.decided({end(balanced), 0.0}); }
  bool may_leave() const { return watch_.may_leave(); }

  TransientRow row(bool lost, bool balanced) {
    return transient_row(settings(machine_), watch_.sums(), lost, end(balanced));
  }

 private:
  TransientSample sample_of(double t, const double* z) const {
    const int n = p_.balls;
    TransientSample s = transient_sample(p_, z[model::machine_index::psi(n)], t, z);
    const double speed = z[model::machine_index::speed(n)];
    if (!motor_.empty()) s.power = motor_[piece_].torque(t, speed, z[model::machine_index::error_integral(n)]) * speed;
    return s;
  }

  // Balls that roll freely in a centred race, without gravity, balance to nothing; other ends are measured.
  std::optional<MotionFigures> end(bool balanced) const {
    const bool exact = p_.race_is_centred() && p_.gravity == 0.0 && !p_.balls_stick();
    return balanced && exact ? std::optional(MotionFigures{}) : std::nullopt;
  }

  TransientSettings settings(const Machine& machine) const {
    TransientSettings s = settings_;
    s.release = std::isfinite(machine.released()) ? machine.released() : 0.0;
    return s;
  }

  const model::Parameters& p_;
  TransientSettings settings_;
  const Machine& machine_;
  TransientWatch watch_;
  std::vector<model::DriveSegment> motor_;  // by piece; of a prescribed speed none
  std::size_t piece_ = 0;
  long events_ = -1;
  bool free_ = false;
  double last_ = -1.0;
};

}  // namespace

void check_machine(const Study& study) {
  check(study);
  check_proof(study);
}

MachineRunner::MachineRunner(const Study& study, const StopFlag* stop)
    : study_(with_horizon(study)),
      stop_(stop),
      drive_(study.drive()),
      sampler_(sampler_of(study)),
      facts_(study_, drive_, stop),
      settled_(drive_.pieces.back().begin) {
  if (!study.speed.driven()) settled_ = std::max(settled_, drive_.release_time);
  for (const SteadyKind& kind : steady_kinds(study.parameters.balls)) {
    Motion motion;
    motion.kind = MotionKind::measured;
    catalogue_.add({kind.id, kind.name, "", motion, {}});
  }
}

bool MachineRunner::run(std::uint64_t first, std::size_t count, std::vector<double>& phi, std::vector<Fate>& fates,
                        std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  const std::vector<InitialState> starts = starts_of(study_, sampler_, study_.sampling.seed, first, count);
  phi.clear();
  for (const InitialState& s : starts) phi.insert(phi.end(), s.phi.begin(), s.phi.begin() + study_.parameters.balls);
  return run_from(starts, fates, unlisted, rows);
}

bool MachineRunner::run_from(std::span<const InitialState> given, std::vector<Fate>& fates,
                             std::vector<UnlistedStart>& unlisted, std::vector<TransientRow>* rows) const {
  unlisted.clear();
  fates.assign(given.size(), Fate{});
  if (rows) rows->assign(given.size(), TransientRow{});
  for (std::size_t i = 0; i < given.size(); ++i) {
    fates[i] = decide(given[i], rows ? &(*rows)[i] : nullptr, nullptr);
    if (is_set(stop_)) return false;  // the last one may have been cut short
  }
  return true;
}

std::vector<UndecidedEnd> MachineRunner::look_at(const std::vector<InitialState>& undecided) const {
  std::vector<UndecidedEnd> ends;
  for (const InitialState& start : undecided) {
    UndecidedEnd end;
    decide(start, nullptr, &end);
    if (is_set(stop_)) break;
    ends.push_back(end);
  }
  return ends;
}

Fate MachineRunner::decide(const InitialState& start, TransientRow* row, UndecidedEnd* end) const {
  const model::Parameters& p = study_.parameters;
  model::Drive drive = drive_;
  if (study_.speed.driven()) drive.psi = start.psi;
  double z[Machine::dimension];
  initial_state(parted(p, start), p.balls, drive.speed, z);
  const double tolerance = study_.numerics.tolerance.value_or(default_basin_tolerance);
  Machine machine(p, drive, ensemble_scale<model::any_count>(p, tolerance), z);
  MachineTransients transients(study_, machine);
  std::optional<MachineJudge> judge;
  std::optional<Fate> decided;
  double last[Machine::dimension];
  const bool at_horizon = study_.numerics.decide == DecideMode::horizon;
  const auto decided_at = [&](double from, double to, auto&& state_at) {
    // Anew where the balls are let go: a rotor that is steady with its balls held may never do so.
    if (!judge || (judge->clamped() && !machine.clamped())) {
      state_at.roughly(from, last);
      judge.emplace(facts_, from, last, machine.clamped(), at_horizon);
    }
    std::array<SteadySample, 3> samples;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      state_at.roughly(k + 1 == nodes.size() ? to : from + nodes[k] * (to - from), last);
      samples[k] = sample(p, last);
    }
    if (judge->step(to, last, samples)) decided = judge->look(to, last);
    // What runs away for ever has no horizon.
    return decided && (!at_horizon || decided->outcome == Outcome::undecided);
  };
  Fate fate;
  bool known = false, ran_away = false;
  // A start that stays open is known by its speed over the last_turns before the horizon.
  const double horizon = settled_ + *study_.numerics.horizon;
  double turns_from = -1.0, psi_from = 0.0;
  const auto observe = [&](double from, double to, auto&& state_at) {
    if (row) transients.step(from, to, state_at);
    if (known) return transients.may_leave();
    // A torque that grows with the speed: steps would shrink for ever.
    if (state_at.roughly(to, last); std::fabs(last[model::machine_index::speed(p.balls)]) > fastest_speed) {
      known = ran_away = true;
      fate = {.time = to, .mean_speed = static_cast<float>(last[model::machine_index::speed(p.balls)])};
      return true;
    }
    if (turns_from < 0.0 && to > horizon - last_turns) {
      turns_from = to;
      psi_from = last[model::machine_index::psi(p.balls)];
    }
    if (to <= settled_ || !decided_at(from, to, state_at)) return false;
    known = true;
    fate = *decided;
    fate.time = to;
    if (!row) return true;
    transients.decided(fate.attractor == balanced_id);
    return false;
  };
  const auto status = machine.advance(horizon, observe, stop_);
  const bool lost = status != IntegrationStatus::done;
  if (lost) {
    fate = {status == IntegrationStatus::diverged ? Outcome::diverged : Outcome::failed, DecidedBy::nothing, 0,
            machine.time()};
  } else if (!known) {
    if (judge) fate = judge->at_horizon(machine.state());
    fate.time = machine.time();
    if (fate.outcome == Outcome::undecided && turns_from >= 0.0 && turns_from < fate.time)
      fate.mean_speed = static_cast<float>((machine.state()[model::machine_index::psi(p.balls)] - psi_from) /
                                           (fate.time - turns_from));
  }
  if (end && ran_away)
    end->what = Restlessness::running_away;
  else if (end && judge)
    *end = judge->end();
  if (row) *row = transients.row(lost, fate.outcome == Outcome::attracted && fate.attractor == balanced_id);
  if (!study_.speed.driven()) fate.mean_speed = std::numeric_limits<float>::quiet_NaN();
  return fate;
}

}  // namespace equipoise
