// Balls in groups that are carried together, and what the drive reaches against the drag of those that hang.
#include "equipoise/machine/balance/carrying.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "equipoise/machine/balance/cancelling.hpp"

namespace equipoise::model {

namespace {

constexpr double without_end = std::numeric_limits<double>::infinity();

// Touching balls, or a single one.
struct Group {
  double drag;  // sum of mu_i beta_i: the torque of all, over the speed
  double from;  // speed from which they are carried
};

std::vector<Group> groups_of(const Parameters& p) {
  std::vector<Group> groups;
  const auto add = [&](double mass, double drag) {
    groups.push_back({drag, drag > 0.0 ? p.gravity * mass / drag : without_end});
  };
  double all = 0.0;
  for (int i = 0; i < p.balls; ++i) {
    all += p.mass[i] * p.drag[i];
    if (!p.balls_collide()) add(p.mass[i], p.mass[i] * p.drag[i]);
  }
  // Side by side they have the largest moment about the shaft, that of the largest unbalance that they can cancel.
  if (p.balls_collide()) add(cancelling(p).most(), all);
  std::sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.from < b.from; });
  return groups;
}

// What a drive reaches in the end against a torque of `drag` times the speed. Left out: what the supports' dampers take
// if the race is off centre.
double speed_against(const System& system, double drag) {
  if (system.prescribed()) return std::fabs(system.speed());
  DriveSegment motor = system.drive().motor;
  if (motor.integral != 0.0) {  // holds its aim if its limit suffices
    if (std::fabs(drag * motor.aim + motor.load(motor.aim)) <= motor.limit) return std::fabs(motor.aim);
    motor.constant = std::copysign(motor.limit, motor.aim);
    motor.slope = motor.integral = 0.0;
    motor.limit = without_end;
  }
  if (motor.is_linear() && motor.slope >= drag) return without_end;
  if (const auto speed = motor.even_speed(drag)) return std::fabs(*speed);
  return motor.torque(motor.begin, 0.0, 0.0) == 0.0 ? 0.0 : without_end;
}

// Of a motor that lets its balls go at a time: as fast as it will ever be.
double speed_at_release(const Drive& drive) {
  if (drive.release_speed) return std::fabs(*drive.release_speed);
  for (const DrivePiece& piece : drive.pieces)
    if (drive.release_time < piece.end && piece.prescribed)
      return std::fabs(piece.motion(false).speed_at(drive.release_time));
  return drive.release_time > 0.0 ? without_end : std::fabs(drive.speed);
}

}  // namespace

std::optional<Carrying> carrying(const Parameters& p, const Drive& drive) {
  if (p.balls == 0 || p.gravity == 0.0) return std::nullopt;
  const System system(p, drive.pieces.back());
  if (system.coasts()) return std::nullopt;
  const std::vector<Group> groups = groups_of(p);
  Carrying c{.first = groups.front().from, .all = groups.back().from};
  double hanging = 0.0;
  for (const Group& group : groups) hanging += group.drag;
  for (const Group& group : groups) {
    c.reached = speed_against(system, hanging);
    if (c.reached < group.from) break;
    hanging -= group.drag;
  }
  const double unbraked = speed_against(system, 0.0);
  if (unbraked == 0.0) return std::nullopt;
  // Let go at the bottom with this speed a ball passes the top, and drag only helps: it is slower than the race on its
  // way up. Let go elsewhere, it is faster than the race when it first comes by the bottom. A tenth is for the rotor's
  // vibration.
  const double passes_the_top = 1.1 * 2.0 * std::sqrt(p.gravity / p.inertia_along_race());
  c.turning = std::min(speed_at_release(drive), unbraked) >= passes_the_top;
  return c;
}

}  // namespace equipoise::model
