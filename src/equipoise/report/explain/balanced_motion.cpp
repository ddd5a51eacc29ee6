// What the rates near balance say of a study, with more and with less drag.
#include "equipoise/report/explain/parts.hpp"

#include <algorithm>
#include <cmath>

#include "equipoise/analyses/one_study/balanced_rates.hpp"
#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

namespace equipoise {

namespace {

std::string less_words(unsigned left_out) {
  std::string text;
  const auto add = [&](LeftOut what, const char* words) {
    if (left_out & what) text += (text.empty() ? "" : ", ") + std::string(words);
  };
  add(dry_friction_left_out, "without dry friction");
  add(gravity_left_out, "without gravity");
  add(unequal_supports_left_out, "with the mean of x and y");
  return text;
}

// How far the race's centre moves from where it rests while the balls rock.
double farthest(const model::System& system, const PeriodicOrbit& orbit) {
  constexpr int looks = 64;
  const auto& offset = system.parameters().race_offset;
  const double sense = system.speed() < 0.0 ? -1.0 : 1.0;
  double most = 0.0;
  int k = 0;
  for (const Eigen::VectorXd& z : sample_orbit(system, orbit, looks)) {
    const auto rest = model::rest_position(system.parameters(), sense * system.section_angle() * k++ / looks);
    most = std::max(most, std::hypot(z[0] + offset[0] - rest[0], z[1] + offset[1] - rest[1]));
  }
  return most;
}

}  // namespace

void linearise(Explanation& e, const StopFlag* stop) {
  const auto skip = [&](const std::string& why) { e.no_motion = why; };
  if (!e.speed) return skip(e.speed_words);
  if (*e.speed == 0.0) return skip("the rotor does not turn");
  if (e.balanced.kind == model::BalancedStates::Kind::none) return skip("there is no balanced state");
  const model::CentredTwin twin = model::centred_twin(e.study.parameters, *e.speed);
  const auto angles = balanced_angles(e.balanced, twin.parameters, e.ball_width);
  if (!angles) return skip("no balanced state of the continuum that was tried leaves the balls room");
  const bool family = e.balanced.kind == model::BalancedStates::Kind::continuum;
  const LinearRotor rotor = linear_rotor(e.study, *e.speed, family);
  BalancedMotion motion;
  motion.angles = *angles;
  for (int i = 0; i < twin.parameters.balls; ++i) motion.angles[static_cast<std::size_t>(i)] += twin.turn;
  const model::System system = rotor.system();
  if (!system.autonomous() && is_too_stiff(rotor.parameters, *e.speed))
    return skip("a turn of the rotor lasts too many periods of its fastest vibration to be followed here");
  const auto linear = balanced_rates(system, motion.angles, family, stop);
  if (is_set(stop)) return skip("it was stopped before it was known");
  if (!linear) {
    const bool gravity = rotor.parameters.gravity != 0.0, uneven = !rotor.parameters.isotropic();
    return skip(std::string("no balanced motion was found with ") + (gravity ? "gravity" : "") +
                (gravity && uneven ? " and " : "") + (uneven ? "unequal supports" : ""));
  }
  motion.less = less_words(rotor.left_out);
  motion.section_period = system.autonomous() ? 0.0 : system.section_period();
  if (linear->orbit && !e.tilt) motion.left = farthest(system, *linear->orbit);
  motion.eigenvalues = linear->rates;
  motion.slowest_rate = motion.eigenvalues.front().real();
  motion.stable = motion.slowest_rate < -least_rate;
  constexpr double part = 1e-3;  // of the drag: a difference far above rounding, far below what bends the curve
  const auto more = balanced_rates(rotor.with_drag(1.0 + part), motion.angles, family, stop);
  const auto less = balanced_rates(rotor.with_drag(1.0 - part), motion.angles, family, stop);
  if (more && less && motion.slowest_rate != 0.0)
    motion.drag_sensitivity =
        (more->rates.front().real() - less->rates.front().real()) / (2.0 * part * motion.slowest_rate);
  if (rotor.parameters.rolls) {
    LinearRotor sliding = rotor;
    sliding.parameters.rolls = false;
    if (const auto slid = balanced_rates(sliding.system(), motion.angles, family, stop))
      motion.slowest_if_sliding = slid->rates.front().real();
  }
  e.motion = motion;
}

}  // namespace equipoise
