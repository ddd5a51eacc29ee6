// What is said of a rotor that tilts: whirl with its gyroscopic moment, vibration along the shaft, and what the balls
// of each plane have to cancel.
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "equipoise/machine/balance/cancelling.hpp"
#include "equipoise/machine/balance/tilt_balance.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/report/explain/parts.hpp"

namespace equipoise {

namespace {

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

}  // namespace

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

}  // namespace equipoise
