// Critical speeds, what the balls can cancel, the linearised approach to balance, and warnings.
#include "equipoise/report/explain/explain.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/report/explain/parts.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"
#include "equipoise/machine/datasheet/ball_drag.hpp"
#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/machine/mechanics/sustained_speed.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/simulation/spin_up/run_up.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/report/text/text.hpp"

namespace equipoise {

namespace {

// When a ramp function reaches its last speed; none if it is constant.
std::optional<double> last_time(const RampSetting& s) {
  if (s.profile == Profile::constant || s.profile == Profile::torque) return std::nullopt;
  return ramp_profile(s).settled_time();
}

// Of a motor, where a balanced rotor needs what the motor gives; of a motor that lets go, the speed then if nothing has
// braked the rotor.
void put_final_speed(Explanation& e) {
  const model::System system = e.study.system();
  e.speed = speed_in_balance(e.study, system);
  if (!e.speed) {
    e.speed_words = std::string("the motor's ") + model::holds_no_speed;
    e.speeds_up = true;
  } else if (system.coasts()) {
    e.speed_words = "which the rotor has when its motor lets go if nothing has braked it; then nothing holds it";
  } else if (!system.prescribed()) {
    const bool centred = system.parameters().race_is_centred(), loaded = !e.study.speed.load.is_none();
    e.speed_words = loaded && centred ? "where the motor gives what the load takes: a balanced rotor needs no more"
                    : loaded          ? "where the motor gives what load and supports' dampers take in balance"
                    : centred         ? "where the motor's torque vanishes: a balanced rotor needs none"
                                      : "where the motor gives what the supports' dampers take in balance";
  }
}

BareVibration bare_vibration(const model::Parameters& p, double speed) {
  BareVibration v;
  for (std::size_t i = 0; i < 2; ++i) {
    const double damping = p.damping[i] * speed;
    v.displacement[i] = p.eccentricity * speed * speed / std::hypot(p.stiffness[i] - speed * speed, damping);
    v.force[i] = v.displacement[i] * std::hypot(p.stiffness[i], damping);
  }
  return v;
}

// Whether the balls can balance the rotor at its final speed, by their masses and by their room.
void balance(Explanation& e) {
  using Kind = model::BalancedStates::Kind;
  model::Parameters p = e.study.parameters;
  if (e.speed && *e.speed != 0.0) p = model::centred_twin(p, *e.speed).parameters;
  p.gravity = 0.0;
  p.race_offset = {0.0, 0.0};  // what it makes of the unbalance is unknown without a speed
  const model::Cancelling room = model::cancelling(p, e.ball_width);
  e.unbalance = p.eccentricity;
  e.least_unbalance = room.least();
  e.largest_unbalance = room.most();
  e.balanced = model::balanced_states(p);
  if (e.balanced.kind == Kind::none || room.cancels(e.unbalance)) return;
  e.balanced = {.kind = Kind::none, .angles = {}, .reason = ""};
  e.balanced.reason = room.why_not(e.unbalance);
}

// The same of a rotor that does not tilt, and its critical speeds and sag.
void explain_plane(Explanation& e) {
  const model::Parameters& p = e.study.parameters;
  for (std::size_t i = 0; i < 2; ++i) e.critical_alone[i] = std::sqrt(p.stiffness[i]);
  e.critical_with_balls = rules::critical_speeds(p);
  if (e.study.speed.driven() && e.speed) e.run_up = run_up(e.study, *e.speed);
  if (p.balls > 0) {
    balance(e);
  } else {
    e.unbalance = p.eccentricity;
    e.balanced.reason = e.no_motion = "there are no balls";
  }
  e.sag = 0.0 - model::static_sag(p);
  if (e.speed) e.bare = bare_vibration(p, *e.speed);
}

}  // namespace

void check_pages(const Study& study) { reject_if_lacking(study, model::ResultKind::pages); }

Explanation explain(const Study& study, const StopFlag* stop) {
  Explanation e;
  const model::Parameters& p = study.parameters;
  const BallDetails& balls = study.ball_details;
  e.study = study;
  e.quantities = quantity_table(study);
  put_final_speed(e);
  e.spin_up = study.speed.driven() ? last_time(study.speed.torque.target) : last_time(study.speed);
  e.ball_width = ball_widths(study);
  p.tilts() ? explain_tilt(e) : explain_plane(e);
  if (p.balls > 0 && p.gravity > 0.0 && e.speed && *e.speed != 0.0) e.gravity_ratio = p.gravity / (*e.speed * *e.speed);
  e.carrying = carrying(study);
  if (p.balls > 0) linearise(e, stop);
  // An undamped rotor at its critical speed shakes more and more.
  if (e.bare && !std::isfinite(e.bare->displacement[0] + e.bare->displacement[1])) e.bare.reset();
  if (e.speed && study.scales && balls.oil_viscosity && balls.oil_density) {
    const double slip =
        std::max(0.0, std::abs(*e.speed) - std::min(e.critical_with_balls[0], e.critical_with_balls[1]));
    const double largest = *std::max_element(balls.diameter.begin(), balls.diameter.end());
    e.reynolds =
        model::reynolds_number(*balls.oil_density, slip * study.scales->velocity(), largest, *balls.oil_viscosity);
  }
  if (p.balls > 0 && !p.tilts()) e.advice = advice(e);
  add_warnings(e);
  return e;
}

}  // namespace equipoise
