// Critical speeds, what the balls can cancel, the linearised approach to balance, and warnings.
#include "equipoise/report/explain/explain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <vector>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/machine/datasheet/ball_drag.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"
#include "equipoise/report/explain/parts.hpp"
#include "equipoise/report/explain/rules_of_thumb.hpp"
#include "equipoise/report/text/text.hpp"
#include "equipoise/simulation/spin_up/run_up.hpp"

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

// Of a plane's balls, none of which meets another plane's.
ExplainedPlane plane_of(const model::BallPlane& plane, const std::vector<double>& widths) {
  std::vector<double> own;
  for (const int ball : plane.balls)
    if (!widths.empty()) own.push_back(widths[static_cast<std::size_t>(ball)]);
  const model::Cancelling room = model::cancelling(plane.rotor, own);
  ExplainedPlane told{plane.at, plane.rotor.eccentricity, room.least(), room.most(), ""};
  if (!room.cancels(told.unbalance)) told.why_not = room.why_not(told.unbalance);
  return told;
}

// The largest force at each bearing, where each is known; else empty.
std::vector<double> forces_at_bearings(const Study& study, const model::ShaftVibration& v, double speed) {
  std::vector<double> forces;
  for (const model::Bearing& b : study.each_bearing())  // half the longer axis, of forces too
    forces.push_back(model::ShaftVibration{v.force_on(b, speed), {}, {}}.farthest(0.0));
  return forces;
}

// For tilting rotors: whirl with its gyroscopic moment, vibration along the shaft, and what the balls of each plane
// have to cancel. The explanation has speed and `ball_width`, which this takes.
void explain_tilt(Explanation& e) {
  const Study& study = e.study;
  const model::Parameters& p = study.parameters;
  TiltExplanation& tilt = e.tilt.emplace();
  tilt.alone = model::whirl_speeds(p, false);
  tilt.with_balls = model::whirl_speeds(p, true);
  e.critical_alone = {tilt.alone.excited().front(), tilt.alone.excited().back()};
  e.critical_with_balls = {tilt.with_balls.excited().front(), tilt.with_balls.excited().back()};
  tilt.couple = std::abs(p.tilt.couple());
  e.unbalance = p.eccentricity;
  e.sag = 0.0 - model::static_sag(p);
  if (p.balls > 0) {
    model::Parameters weightless = p;
    weightless.gravity = 0.0;
    e.balanced = model::balanced_states(weightless);
    for (const model::BallPlane& plane : model::planes_of_balls(p)) {
      tilt.planes.push_back(plane_of(plane, e.ball_width));
      if (tilt.planes.back().why_not.empty() || e.balanced.kind == model::BalancedStates::Kind::none) continue;
      e.balanced = {.kind = model::BalancedStates::Kind::none, .angles = {}, .reason = tilt.planes.back().why_not};
    }
  } else {
    e.balanced.reason = e.no_motion = "there are no balls";
  }
  e.ball_width.clear();  // of balls in one race; here each plane's have been asked
  if (!e.speed) return;
  const model::ShaftVibration v = model::shaft_vibration(p, std::abs(*e.speed));
  const auto size = [](const auto& amplitude) { return std::array{std::abs(amplitude[0]), std::abs(amplitude[1])}; };
  e.bare = BareVibration{size(v.centre), size(v.force)};
  for (const double at : study.bearings) tilt.at_bearings.push_back(v.farthest(at));
  tilt.forces = forces_at_bearings(study, v, std::abs(*e.speed));
}

}  // namespace

void check_pages(const Study& study) { reject_if_lacking(study, model::ResultKind::pages); }

Explanation explain(const Study& study, const StopFlag* stop) {
  Explanation e;
  const model::Parameters& p = study.parameters;
  const DataSheet& sheet = study.sheet;
  const std::span<const double> diameters = study.ball_diameters();
  e.study = study;
  e.quantities = quantity_table(study);
  put_final_speed(e);
  e.spin_up = study.speed.driven() ? last_time(study.speed.torque.target) : last_time(study.speed);
  e.ball_width = ball_widths(study);
  p.tilts() ? explain_tilt(e) : explain_plane(e);
  if (p.balls > 0 && p.gravity > 0.0 && e.speed && *e.speed != 0.0) e.gravity_ratio = p.gravity / (*e.speed * *e.speed);
  e.carrying = carrying(study);
  if (p.balls > 0) linearise(e, stop);
  // An undamped rotor at its critical speed vibrates more and more.
  if (e.bare && !std::isfinite(e.bare->displacement[0] + e.bare->displacement[1])) e.bare.reset();
  if (e.speed && study.scales && sheet.oil_viscosity && sheet.oil_density && !diameters.empty()) {
    const double slip =
        std::max(0.0, std::abs(*e.speed) - std::min(e.critical_with_balls[0], e.critical_with_balls[1]));
    const double largest = *std::max_element(diameters.begin(), diameters.end());
    e.reynolds =
        model::reynolds_number(*sheet.oil_density, slip * study.scales->velocity(), largest, *sheet.oil_viscosity);
  }
  if (p.balls > 0 && !p.tilts()) e.advice = advice(e);
  add_warnings(e, stop);
  return e;
}

}  // namespace equipoise
