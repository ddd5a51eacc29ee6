// Torque laws and their smooth pieces.
#include "equipoise/machine/drives/motor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "equipoise/core/base/angles.hpp"

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

// Constant below the first speed, where the first bend stands; above the last the last line goes on.
DriveSegment curve_segment(const std::vector<double>& speeds, const std::vector<double>& values) {
  DriveSegment piece{.begin = 0.0, .end = forever, .constant = values.front()};
  double slope = 0.0;
  for (std::size_t k = 1; k < speeds.size(); ++k) {
    const double next = (values[k] - values[k - 1]) / (speeds[k] - speeds[k - 1]);
    if (next == slope) continue;
    const int place = piece.bends.count++;
    piece.bends.at[place] = speeds[k - 1];
    piece.bends.by[place] = next - slope;
    slope = next;
  }
  return piece;
}

}  // namespace

std::optional<double> MotorLaw::final_speed() const {
  if (kind == Kind::control && (integral != 0.0 || load.is_none())) return aim.final_speed();
  if (load.is_none() && kind != Kind::curve) {
    if (kind == Kind::linear && slope < 0.0 && !until) return -constant / slope;
    return std::nullopt;
  }
  return drive_segments(*this).back().even_speed(0.0);
}

double DriveSegment::uncut(double t, double speed, double error_integral) const {
  const double line = constant + rate * (t - begin) + slope * speed + integral * error_integral;
  return bends.count == 0 ? line : line + bends(speed);
}

double DriveSegment::motor_torque(double t, double speed, double error_integral) const {
  return std::clamp(uncut(t, speed, error_integral), -limit, limit);
}

double DriveSegment::torque(double t, double speed, double error_integral) const {
  const double motor = motor_torque(t, speed, error_integral);
  return load.is_none() ? motor : motor - load(speed);
}

bool DriveSegment::is_idle() const { return constant == 0.0 && slope == 0.0 && integral == 0.0 && is_linear(); }

bool DriveSegment::brakes() const {
  if (integral != 0.0 || load.quadratic > 0.0) return true;
  double fast = slope - load.linear;
  for (int k = 0; k < bends.count; ++k) fast += bends.by[k];
  return fast < 0.0;
}

namespace {

// Zeros of a polynomial of degree two at most on (low, high], given by three values: f must fall through zero there.
void falls_through(const DriveSegment& piece, double damping, double low, double high, std::vector<double>& zeros) {
  const auto f = [&](double speed) { return piece.torque(piece.begin, speed, 0.0) - damping * speed; };
  // A parabola that rises and falls crosses twice: its halves, from its top on, cross at most once each.
  const double middle = 0.5 * (low + high), bend = f(low) - 2.0 * f(middle) + f(high), tilt = f(high) - f(low);
  std::array<double, 3> ends{low, high, high};
  if (bend != 0.0)
    if (const double top = middle - 0.25 * (high - low) * tilt / bend; top > low && top < high) ends[1] = top;
  for (int half = 0; half < 2; ++half) {
    double a = ends[half], b = ends[half + 1];
    if (!(f(a) > 0.0 && f(b) <= 0.0)) continue;
    for (double c = 0.5 * (a + b); c > a && c < b; c = 0.5 * (a + b)) (f(c) > 0.0 ? a : b) = c;
    zeros.push_back(b);
  }
}

}  // namespace

std::optional<double> DriveSegment::even_speed(double damping) const {
  if (is_linear()) {
    if (slope == damping) return std::nullopt;
    const double speed = constant / (damping - slope);
    if (std::fabs(damping * speed) <= limit) return speed;
    return std::copysign(limit / damping, constant);  // the motor delivers its limit
  }
  // Between these speeds the torque is a polynomial of degree two at most.
  std::vector<double> corners{-Load::creeping, 0.0, Load::creeping};
  for (int k = 0; k < bends.count; ++k) corners.push_back(bends.at[k]);
  if (std::isfinite(limit) && slope != 0.0)
    for (const double cut : {limit, -limit}) corners.push_back((cut - constant) / slope);
  std::sort(corners.begin(), corners.end());
  // Far enough out the highest power decides.
  double reach = 1.0 + std::max(std::fabs(corners.front()), std::fabs(corners.back()));
  for (int k = 0; k < 60 && (torque(begin, reach, 0.0) - damping * reach > 0.0 ||
                             torque(begin, -reach, 0.0) + damping * reach < 0.0);
       ++k)
    reach *= 2.0;
  corners.insert(corners.begin(), -reach);
  corners.push_back(reach);
  std::vector<double> zeros;
  for (std::size_t k = 1; k < corners.size(); ++k) falls_through(*this, damping, corners[k - 1], corners[k], zeros);
  if (zeros.empty()) return std::nullopt;
  return torque(begin, 0.0, 0.0) < 0.0 ? zeros.front() : zeros.back();
}

DriveSegment DriveSegment::mirrored() const {
  DriveSegment other = *this;
  other.constant = -constant;
  other.rate = -rate;
  other.aim = -aim;
  other.aim_rate = -aim_rate;
  // -max(0, -w - a) = (w + a) - max(0, w + a)
  for (int k = 0; k < bends.count; ++k) {
    const int place = bends.count - 1 - k;
    other.slope += bends.by[k];
    other.constant += bends.by[k] * bends.at[k];
    other.bends.at[place] = -bends.at[k];
    other.bends.by[place] = -bends.by[k];
  }
  return other;
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
  } else if (law.kind == MotorLaw::Kind::curve) {
    pieces.push_back(curve_segment(law.speeds, law.values));
  } else {
    linear_pieces(law.aim.times, law.aim.speeds, [&](double begin, double end, double aim, double aim_rate) {
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
  for (DriveSegment& piece : pieces) piece.load = law.load;
  return pieces;
}

namespace {
double slip(const Nameplate& motor, double speed) { return 1.0 - speed / motor.synchronous_speed; }
}  // namespace

double breakdown_slip(const Nameplate& motor) {
  const double k = motor.breakdown_ratio;
  return slip(motor, motor.rated_speed) * (k + std::sqrt(k * k - 1.0));
}

double nameplate_torque(const Nameplate& motor, double speed) {
  const double s = slip(motor, speed), top = breakdown_slip(motor);
  const auto kloss = [&](double at) {
    return 2.0 * motor.breakdown_ratio * motor.rated_torque * at * top / (at * at + top * top);
  };
  if (!motor.locked_rotor_ratio || s <= top || top >= 1.0) return kloss(s);
  // Kloss's torque lies (s - top)^2/(s^2 + top^2) of the breakdown torque below it. If what is added grows as (s -
  // top)^2, the sum stays below it as well.
  const double way = (s - top) / (1.0 - top);
  return kloss(s) + (*motor.locked_rotor_ratio * motor.rated_torque - kloss(1.0)) * way * way;
}

CurvePoints nameplate_curve(const Nameplate& motor) {
  constexpr int samples = 4000;
  constexpr std::size_t points = 20;
  static_assert(points <= static_cast<std::size_t>(most_curve_points));
  const auto speed = [&](int i) { return motor.synchronous_speed * i / samples; };
  std::vector<double> torque;
  for (int i = 0; i <= samples; ++i) torque.push_back(nameplate_torque(motor, speed(i)));
  // The sample that is furthest from its chord becomes the next point.
  std::vector<int> chosen{0, samples};
  while (chosen.size() < points) {
    int farthest = 0;
    double most = 0.0;
    for (std::size_t k = 1; k < chosen.size(); ++k) {
      const int low = chosen[k - 1], high = chosen[k];
      for (int i = low + 1; i < high; ++i) {
        const double share = static_cast<double>(i - low) / (high - low);
        const double off = std::fabs(torque[i] - (torque[low] + share * (torque[high] - torque[low])));
        if (off > most) {
          most = off;
          farthest = i;
        }
      }
    }
    if (most == 0.0) break;
    chosen.insert(std::upper_bound(chosen.begin(), chosen.end(), farthest), farthest);
  }
  CurvePoints curve;
  for (const int i : chosen) {
    curve.speeds.push_back(speed(i));
    curve.torques.push_back(torque[i]);
  }
  return curve;
}

std::vector<double> synchronous_speeds(double rated_speed) {
  constexpr double largest_excess = 0.1;
  constexpr int most_pole_pairs = 24;
  std::vector<double> speeds;
  for (const double mains : {50.0, 60.0})
    for (int pairs = 1; pairs <= most_pole_pairs; ++pairs) {
      const double speed = two_pi * mains / pairs;
      if (speed > rated_speed && speed <= (1.0 + largest_excess) * rated_speed) speeds.push_back(speed);
    }
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end(), [](double a, double b) { return b - a < 1e-9 * b; }),
               speeds.end());
  return speeds;
}

}  // namespace equipoise::model
