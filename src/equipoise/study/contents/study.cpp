// What follows from a study's settings: ramp function, motor, release, system.
#include "equipoise/study/contents/study.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/mechanics/forced_vibration.hpp"
#include "equipoise/machine/model/system.hpp"

namespace equipoise {

namespace {

// A Hill function never comes to its limit: from `until` on its tangent does.
model::SpeedProfile hill_profile(const RampSetting& speed) {
  constexpr double usual_share = 0.999;  // of the limit, at `until`
  model::SpeedProfile profile;
  const model::HillFunction hill{speed.final, speed.half_time, speed.exponent};
  const double until =
      speed.until.value_or(speed.half_time * std::pow(usual_share / (1.0 - usual_share), 1.0 / speed.exponent));
  const double share = 1.0 / (1.0 + std::pow(speed.half_time / until, speed.exponent));
  profile.times = {0.0, until, until + until / (speed.exponent * share)};
  profile.speeds = {0.0, hill.speed(until), speed.final};
  profile.hill = hill;
  return profile;
}

// The speed above which supports isolate, or nearly the speed that the motor aims at, if that is lower.
double usual_stall_speed(const Study& study) {
  const auto aim = study.motor().final_speed();
  return aim ? std::min(std::sqrt(2.0), 0.9 * std::fabs(*aim)) : std::sqrt(2.0);
}

}  // namespace

model::SpeedProfile ramp_profile(const RampSetting& speed) {
  if (speed.profile == Profile::hill) return hill_profile(speed);
  model::SpeedProfile profile;
  if (speed.profile == Profile::constant) {
    profile.speeds = {speed.speed};
  } else if (speed.profile == Profile::ramp) {
    profile.times = {0.0, speed.duration};
    profile.speeds = {speed.initial, speed.final};
  } else if (speed.profile == Profile::trapezoid) {
    profile.times = {0.0, speed.rise_until, speed.hold_until, speed.fall_until};
    profile.speeds = {speed.initial, speed.peak, speed.peak, speed.final};
  } else {
    profile.times = speed.times;
    profile.speeds = speed.speeds;
  }
  return profile;
}

model::SpeedProfile Study::speed_profile() const {
  model::SpeedProfile profile;
  if (speed.driven())
    profile.speeds = {motor().final_speed().value_or(speed.initial)};
  else
    profile = ramp_profile(speed);
  profile.law = speed.law;
  profile.initial_angle = initial.psi;
  return profile;
}

std::string never_reached(const model::SpeedProfile& profile, const std::function<std::string(double)>& shown) {
  const auto [low, high] = std::minmax_element(profile.speeds.begin(), profile.speeds.end());
  return fmt::format("the ramp function never reaches it; must be from {} to {}", shown(*low), shown(*high));
}

std::array<double, model::max_balls> even_angles(int balls) {
  std::array<double, model::max_balls> phi{};
  for (int i = 0; i < std::min(balls, model::max_balls); ++i) phi[i] = two_pi * i / balls;
  return phi;
}

bool states_angles(const Study& study) {
  return study.angles_stated || study.initial.phi != even_angles(study.parameters.balls);
}

double Study::release_time() const {
  if (release.time) return *release.time;
  if (speed.driven())
    return release.speed && *release.speed != speed.initial ? std::numeric_limits<double>::infinity() : 0.0;
  const model::SpeedProfile profile = speed_profile();
  if (release.speed) {
    const auto time = profile.first_time_at(*release.speed);
    if (!time)
      throw InputError(name, "release.speed", fmt::format("{}", *release.speed),
                       never_reached(profile, [](double v) { return fmt::format("{}", v); }));
    return *time;
  }
  return speed.profile == Profile::trapezoid ? speed.rise_until : profile.settled_time();
}

model::MotorLaw Study::motor() const {
  const TorqueSetting& t = speed.torque;
  model::MotorLaw law = t;
  if (t.by_stall) {
    law.constant = t.stall;
    law.slope = -t.stall / t.no_load_speed;
  }
  const LoadSetting& l = speed.load;
  law.load.constant = l.constant;
  if (l.linear != 0.0) law.load.linear = l.linear / *l.at;
  if (l.quadratic != 0.0) law.load.quadratic = l.quadratic / (*l.at * *l.at);
  if (t.kind == model::MotorLaw::Kind::control) law.aim = ramp_profile(t.target);
  return law;
}

model::Drive Study::drive() const {
  const double release_at = release_time();
  if (!speed.driven()) return model::prescribed_drive(model::segments(speed_profile(), release_at));
  model::Drive drive = model::motor_drive(motor(), initial.psi, speed.initial);
  drive.release_time = release_at;
  drive.release_speed = release.speed;
  return drive;
}

std::vector<model::Bearing> Study::each_bearing() const {
  const std::size_t count = bearings.size();
  if (bearings_stiffness.empty())
    return count == 2 ? model::two_bearings(parameters, {bearings[0], bearings[1]}) : std::vector<model::Bearing>{};
  std::vector<model::Bearing> each;
  for (std::size_t b = 0; b < count; ++b) {
    const auto of = [&](const std::vector<double>& values) {
      return values.size() == count ? std::array{values[b], values[b]} : std::array{values[2 * b], values[2 * b + 1]};
    };
    each.push_back({bearings[b], of(bearings_stiffness), of(bearings_damping)});
  }
  return each;
}

model::System Study::system() const {
  if (!speed.driven()) return {parameters, speed_profile().final_speed()};
  return {parameters, model::motor_drive(motor(), initial.psi, speed.initial).pieces.back()};
}

double Study::stall_speed() const { return speed.stalled_below ? *speed.stalled_below : usual_stall_speed(*this); }

double Study::passed_speed() const {
  return std::max(model::highest_critical_speed(parameters), usual_stall_speed(*this));
}

}  // namespace equipoise
