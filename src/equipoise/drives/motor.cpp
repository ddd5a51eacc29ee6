// Torque laws and their smooth pieces.
#include "equipoise/drives/motor.hpp"

#include <algorithm>
#include <cstddef>

namespace equipoise::model {

namespace {

constexpr double forever = std::numeric_limits<double>::infinity();

// Piecewise linear through (times, values), constant outside: value and slope on each piece.
template <class Emit>
void linear_pieces(const std::vector<double>& times, const std::vector<double>& values, const Emit& emit) {
  if (times.front() > 0.0) emit(0.0, times.front(), values.front(), 0.0);
  for (std::size_t i = 1; i < times.size(); ++i)
    emit(times[i - 1], times[i], values[i - 1], (values[i] - values[i - 1]) / (times[i] - times[i - 1]));
  emit(times.back(), forever, values.back(), 0.0);
}

}  // namespace

std::optional<double> MotorLaw::final_speed() const {
  if (kind == Kind::control) return target.final_speed();
  if (kind == Kind::linear && slope < 0.0 && !until) return -constant / slope;
  return std::nullopt;
}

double DriveSegment::uncut(double t, double speed, double error_integral) const {
  return constant + rate * (t - begin) + slope * speed + integral * error_integral;
}

double DriveSegment::torque(double t, double speed, double error_integral) const {
  return std::clamp(uncut(t, speed, error_integral), -limit, limit);
}

double DriveSegment::error_rate(double t, double speed, double error_integral) const {
  if (integral == 0.0) return 0.0;
  const double error = aim + aim_rate * (t - begin) - speed;
  const double torque = uncut(t, speed, error_integral);
  const bool cut_further = (torque > limit && error * integral > 0.0) || (torque < -limit && error * integral < 0.0);
  return cut_further ? 0.0 : error;
}

std::vector<DriveSegment> drive_segments(const MotorLaw& law) {
  std::vector<DriveSegment> pieces;
  if (law.kind == MotorLaw::Kind::linear) {
    if (!law.until || *law.until > 0.0)
      pieces.push_back(
          {.begin = 0.0, .end = law.until.value_or(forever), .constant = law.constant, .slope = law.slope});
    if (law.until) pieces.push_back({.begin = *law.until, .end = forever});
  } else if (law.kind == MotorLaw::Kind::table) {
    linear_pieces(law.times, law.values, [&](double begin, double end, double value, double rate) {
      pieces.push_back({.begin = begin, .end = end, .constant = value, .rate = rate});
    });
  } else {
    linear_pieces(law.target.times, law.target.speeds, [&](double begin, double end, double aim, double aim_rate) {
      pieces.push_back({.begin = begin,
                        .end = end,
                        .constant = law.gain * aim,
                        .slope = -law.gain,
                        .rate = law.gain * aim_rate,
                        .integral = law.integral,
                        .aim = aim,
                        .aim_rate = aim_rate,
                        .limit = law.limit.value_or(forever)});
    });
  }
  return pieces;
}

}  // namespace equipoise::model
