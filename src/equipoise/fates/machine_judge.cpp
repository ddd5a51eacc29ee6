// Balance by stability and approach, all else by features that no longer change.
#include "equipoise/fates/machine_judge.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/base/angles.hpp"
#include "equipoise/deciding/decision_rule.hpp"
#include "equipoise/discovery/horizon.hpp"
#include "equipoise/fates/machine_fade.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/motions/catalogue.hpp"
#include "equipoise/motions/stuck.hpp"
#include "equipoise/orbits/continuum_draws.hpp"
#include "equipoise/traps/balanced_analysis.hpp"

namespace equipoise {

namespace {

constexpr int locked_id = 7;
// This near to a balanced state, in balls' angles, what seems to rest may be on its slow way there, or away from there.
constexpr double near_balance = 0.05;
// A speed that comes this near to the one at which balls are let go, as a share of it, may reach it yet.
constexpr double nearly_let_go = 1e-3;

// The part of a continuum of balanced states that is stable, of so many drawn.
std::optional<double> stable_share(const MachineBalance& balance, double speed) {
  const model::Parameters& p = balance.machine().parameters();
  const int members = p.isotropic() ? 64 : 12;
  ContinuumDraws draws(p);
  std::array<double, model::max_balls> phi{};
  int found = 0, stable = 0;
  for (; found < members && draws.next(phi); ++found)
    stable += balance.linearised(balance.machine().balanced_state(phi.data(), speed)).stable();
  if (found == 0) return std::nullopt;
  return static_cast<double>(stable) / found;
}

// What the study has that leaves no state at rest.
std::string left_of_continuum(const model::Parameters& p) {
  const bool gravity = p.gravity != 0.0, offset = !p.race_is_centred();
  return fmt::format("of the continuum of balanced states {} single ones; their stability is that without",
                     gravity && offset ? "gravity and an off-centre race leave"
                     : gravity         ? "gravity leaves"
                                       : "an off-centre race leaves");
}

double patience_for(Study study) {
  study.numerics.horizon.reset();
  study.numerics.decide = DecideMode::validated;
  return choose_horizon(study).time;
}

model::Parameters centred(model::Parameters p) {
  p.race_offset = {0.0, 0.0};
  p.gravity = 0.0;
  return p;
}

}  // namespace

MachineFacts::MachineFacts(const Study& study, const model::Drive& drive, const StopFlag* stop)
    : study_(study),
      stop_(stop),
      balance_(study.parameters, drive.pieces.back()),
      release_speed_(study.speed.driven() ? study.release.speed : std::nullopt),
      patience_(patience_for(study)),
      note_(make_note()) {}

bool MachineFacts::smooth_and_isotropic() const {
  const model::System& system = balance_.machine().system();
  return system.autonomous() && system.smooth();
}

bool MachineFacts::below_stall(double speed) const {
  return study_.speed.driven() && std::fabs(speed) < study_.stall_speed();
}

bool MachineFacts::runs_away(double speed) const {
  return balance_.machine().system().runs_away(speed);
}

// Stability of exact balance, at the speed that it comes with.
BalanceNote MachineFacts::exact_note() const {
  const std::optional<double> speed = balance_.machine().balanced_speed();
  if (!speed) return {false, "no torque acts in the end, and which speed the rotor keeps is not known beforehand"};
  if (*speed == 0.0) return {false, "the rotor comes to rest: nothing balances it"};
  const model::BalancedStates& states = balance_.states();
  if (states.kind == model::BalancedStates::Kind::family) {
    const auto share = stable_share(balance_, *speed);
    if (!share) return {false, "no balanced state was found"};
    if (*share == 1.0) return {true, ""};
    if (*share == 0.0)
      return {false, fmt::format("the balanced states exist but are unstable at speed {:.6g}", *speed)};
    return {true,
            fmt::format("about {:.0f} % of the balanced states are stable at speed {:.6g}", 100.0 * *share, *speed)};
  }
  double slowest = -1e300;
  for (const auto& phi : states.angles)
    slowest = std::max(slowest, balance_.linearised(balance_.machine().balanced_state(phi.data(), *speed)).rate);
  if (slowest > 0.0) return {true, ""};
  return {false, fmt::format("the balanced state exists but is unstable at speed {:.6g} (growth rate {:.3g})", *speed,
                             -slowest)};
}

BalanceNote MachineFacts::make_note() {
  const model::Parameters& p = parameters();
  const std::optional<double> speed = balance_.machine().balanced_speed();
  if (balance_.exists()) {
    BalanceNote note = exact_note();
    if (note.stable && p.balls_stick())
      note.note =
          "balls that resist rolling come to rest near balance, not at it; its stability is that without "
          "resistance";
    return note;
  }
  const model::BalancedStates states = model::balanced_states(centred(p));
  if (states.kind == model::BalancedStates::Kind::none) return {false, "no balanced state exists: " + states.reason};
  if (!speed && !balance_.machine().coasts()) return {false, balance_.reason()};
  if (!speed || *speed == 0.0) return {false, "at which speed the rotor ends is not known beforehand"};
  if (states.kind == model::BalancedStates::Kind::isolated && model::is_strobed(p)) {
    // As if the race were centred and the speed did not waver.
    model::Parameters at_centre = p;
    at_centre.race_offset = {0.0, 0.0};
    const BalancedAnalysis found = analyse_balanced({at_centre, *speed});
    strobed_balance_unstable_ = !found.stable;
    return {found.stable, found.note};
  }
  if (states.kind == model::BalancedStates::Kind::isolated) {
    // What the balanced state becomes as the race moves off centre.
    model::DrivePiece last = study_.drive().pieces.back();
    const MachineBalance at_centre(centred(p), last);
    for (const auto& phi : states.angles) {
      std::optional<Eigen::VectorXd> y = at_centre.machine().balanced_state(phi.data(), *speed);
      constexpr int steps = 20;
      for (int k = 1; k <= steps && y; ++k) {
        model::Parameters part = p;
        for (double& e : part.race_offset) e *= static_cast<double>(k) / steps;
        y = rest_state(model::FreeMachine(part, last), *y, 0.5);
      }
      if (y && linear_balance(balance_.machine().jacobian(*y), 0).stable()) return {true, ""};
    }
    return {false, fmt::format("the state that balance becomes with the race off centre is unstable, or is none, at "
                               "speed {:.6g}",
                               *speed)};
  }
  const MachineBalance perfect(centred(p), study_.drive().pieces.back());
  const auto share = stable_share(perfect, *speed);
  if (share && *share > 0.0) return {true, left_of_continuum(p)};
  return {false, fmt::format("the balanced states are unstable at speed {:.6g}", *speed)};
}

// An equilibrium of a smooth isotropic machine: nothing if it is unstable, else whether it is balance, or what balance
// becomes as the race moves off centre.
std::optional<bool> MachineFacts::equilibrium_balanced(const Eigen::VectorXd& at) const {
  const model::FreeMachine& machine = balance_.machine();
  const model::Parameters& p = parameters();
  const bool continuum = model::balanced_states(centred(p)).kind == model::BalancedStates::Kind::family;
  const int along = continuum ? std::max(p.balls - 2, 1) : 0;
  // An off-centre race leaves hardly any force along what was the continuum.
  const int slow = p.race_is_centred() ? 0 : along;
  if (!linear_balance(machine.jacobian(at), slow).stable()) return std::nullopt;
  if (p.race_is_centred()) return false;  // balanced states are told by nearing them
  Eigen::VectorXd y = at;
  const model::DrivePiece last = study_.drive().pieces.back();
  constexpr int steps = 20;
  for (int k = steps - 1; k >= 0; --k) {
    model::Parameters part = p;
    for (double& e : part.race_offset) e *= static_cast<double>(k) / steps;
    const auto next = rest_state(model::FreeMachine(part, last), y, 0.5);
    if (!next) return false;
    y = *next;
  }
  const auto moved = (y - at).segment(4, p.balls).cwiseAbs().maxCoeff();
  const MachineBalance perfect(centred(p), last);
  return y.head(2).norm() < 1e-9 && moved < 0.5 * pi && perfect.linearised(y).stable();
}

// Under dry friction any state in a set may stay; balanced are those that also shake less than half as much as the
// rotor would without balls.
bool MachineFacts::fades(const double* z, const SteadyLook& look) const {
  const model::Parameters& p = parameters();
  if (std::fabs(look.speed) < 1e-3) return false;
  if (p.balls_stick()) {
    const double bare = bare_response(p, look.speed);
    if (look.r_rms > std::max(0.5 * bare, 1e-6)) return false;
  }
  const double tolerance = study_.numerics.tolerance.value_or(default_basin_tolerance);
  return fades_to_balance(p, look.speed, z, tolerance, patience_, stop_);
}

std::optional<bool> MachineFacts::rests_balanced(const double* z, const SteadyLook& look) const {
  const model::Parameters& p = parameters();
  // Exact balance does not swing, and what swings steadily is not on its way there.
  const bool exact = balance_.exists() && !p.balls_stick();
  if ((exact || smooth_and_isotropic()) && (look.swinging || !look.resting)) return false;
  if (smooth_and_isotropic()) {
    const auto at = rest_state(balance_.machine(), balance_.machine().reduced(z), 0.3);
    return at ? equilibrium_balanced(*at) : std::nullopt;
  }
  if (exact) return look.repeats ? std::optional(false) : std::nullopt;  // balls that touch
  const bool balanced = fades(z, look);
  if (balanced && strobed_balance_unstable_) return std::nullopt;
  return balanced;
}

MachineJudge::MachineJudge(const MachineFacts& facts, double t, const double* z, bool clamped, bool to_horizon)
    : facts_(facts),
      watch_(facts.parameters(), facts.parameters().balls > 2 &&
                                     (facts.parameters().gravity != 0.0 || !facts.parameters().race_is_centred())),
      approach_(facts.balance()),
      clamped_(clamped),
      to_horizon_(to_horizon),
      nearest_speed_(z[model::machine_index::speed(facts.parameters().balls)]) {
  watch_.begin(t, z[model::machine_index::psi(facts.parameters().balls)], z + 4);
}

bool MachineJudge::step(double t, const double* z, const std::array<SteadySample, 3>& samples) {
  const int balls = facts_.parameters().balls;
  const double speed = z[model::machine_index::speed(balls)];
  if (const auto& release = facts_.release_speed())
    if (std::fabs(speed - *release) < std::fabs(nearest_speed_ - *release)) nearest_speed_ = speed;
  return watch_.step(t, z[model::machine_index::psi(balls)], samples);
}

Fate MachineJudge::attracted(int id, DecidedBy by, double speed) const {
  if (facts_.below_stall(speed)) return {Outcome::stalled, by, 0, 0.0, static_cast<float>(speed)};
  return {Outcome::attracted, by, static_cast<short>(id), 0.0, static_cast<float>(speed)};
}

Fate MachineJudge::stalled() const {
  return {Outcome::stalled, DecidedBy::windows, 0, 0.0, static_cast<float>(watch_.mean_speed())};
}

std::optional<Fate> MachineJudge::look(double t, const double* z) {
  using Verdict = BalanceApproach::Verdict;
  if (balanced_) return std::nullopt;
  // Under dry friction balance is not approached but for rest somewhere near.
  if (!clamped_ && !facts_.parameters().balls_stick()) {
    const Verdict verdict = approach_.look(t, z);
    balanced_ = verdict != Verdict::none;
    // The rotor may have been run up a moment ago: its speed from now on is the present one.
    const double speed = z[model::machine_index::speed(facts_.parameters().balls)];
    if (balanced_)
      return attracted(balanced_id, verdict == Verdict::held ? DecidedBy::validated : DecidedBy::windows, speed);
  }
  if (watch_.blocks() < next_look_) return std::nullopt;
  next_look_ = watch_.blocks() + std::max<std::size_t>(2, watch_.blocks() / 5);
  const SteadyLook now = watch_.look();
  if (!now.enough) return std::nullopt;
  note_passing(now);
  // Nothing more is to come.
  if (facts_.runs_away(now.speed) || held_for_good(now)) return Fate{.mean_speed = static_cast<float>(now.speed)};
  if (facts_.below_stall(now.speed)) return stalls(now) ? std::optional(stalled()) : std::nullopt;
  return to_horizon_ ? std::nullopt : told(now, z);
}

// Keeps since when it has been below the stall speed, and since when its balls have done what they do.
void MachineJudge::note_passing(const SteadyLook& now) {
  const bool slow = facts_.below_stall(now.speed) && now.speed_steady;
  if (!slow) slow_since_ = -1.0;
  if (slow && slow_since_ < 0.0) slow_since_ = watch_.watched();
  if (!now.speed_steady || now.kind == 0) passed_kind_ = 0;
  if (!now.speed_steady || now.kind == 0 || now.trending || passed_kind_ == now.kind) return;
  passed_kind_ = now.kind;
  passed_at_ = watch_.watched();
}

bool MachineJudge::stalls(const SteadyLook& now) const {
  // A rotor without torque only loses speed.
  if (facts_.coasts() && now.slowing) return true;
  const bool lasting = slow_since_ >= 0.0 && watch_.watched() > 1.5 * slow_since_;
  return now.speed_steady && (lasting || now.repeats);
}

// Its balls are held until a speed that the rotor does not come to.
bool MachineJudge::held_for_good(const SteadyLook& now) const {
  const auto& release = facts_.release_speed();
  if (!clamped_ || !release || facts_.below_stall(now.speed)) return false;
  if (std::fabs(nearest_speed_ - *release) < nearly_let_go * std::fabs(*release)) return false;
  return now.speed_steady && !now.trending && (now.repeats || watch_.watched() > unrepeated_time);
}

// Of a rotor above its stall speed.
std::optional<Fate> MachineJudge::told(const SteadyLook& now, const double* z) const {
  if (clamped_ || !now.speed_steady || now.kind == 0 || now.trending) return std::nullopt;
  const bool lasting = passed_kind_ == now.kind && watch_.watched() > std::max(2.0 * passed_at_, unrepeated_time);
  if (!now.repeats && !lasting) return std::nullopt;
  if (now.kind != locked_id) return attracted(now.kind, DecidedBy::windows, now.speed);
  if (!now.swinging && approach_.distance() < near_balance) return std::nullopt;
  const auto balanced = facts_.rests_balanced(z, now);
  if (!balanced) return std::nullopt;
  return attracted(*balanced ? balanced_id : locked_id, DecidedBy::windows, now.speed);
}

Fate MachineJudge::at_horizon(const double* z) const {
  std::optional<Fate> fate;
  const SteadyLook now = watch_.look();
  if (balanced_)
    fate = attracted(balanced_id, DecidedBy::horizon, z[model::machine_index::speed(facts_.parameters().balls)]);
  else if (now.enough && facts_.below_stall(now.speed))
    fate = stalls(now) ? std::optional(stalled()) : std::nullopt;
  else if (now.enough)
    fate = told(now, z);
  if (!fate) return {.mean_speed = static_cast<float>(watch_.mean_speed())};
  fate->by = DecidedBy::horizon;
  return *fate;
}

UndecidedEnd MachineJudge::end() const {
  const auto& release = facts_.release_speed();
  if (clamped_ && release) return {.what = Restlessness::held, .reached = nearest_speed_, .asked = *release};
  const SteadyLook now = watch_.look();
  if (!now.enough) return {.what = Restlessness::hardly_seen};
  if (facts_.runs_away(now.speed)) return {.what = Restlessness::running_away};
  if (now.quickening && !now.speed_steady)
    return {.what = Restlessness::speeding_up, .reached = std::fabs(watch_.mean_speed())};
  if (!now.speed_steady) return {.what = Restlessness::changing_speed};
  if (approach_.distance() < near_balance) return {.what = Restlessness::near_balance};
  if (now.trending) return {.what = Restlessness::changing};
  if (now.kind == 0) return {.what = Restlessness::between_kinds};
  if (now.kind == locked_id && now.repeats) return {.what = Restlessness::creeping};
  return {.what = Restlessness::unrepeated};
}

}  // namespace equipoise
