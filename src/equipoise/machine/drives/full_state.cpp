// Drives made from prescribed motions and from motors.
#include "equipoise/machine/drives/full_state.hpp"

#include <limits>

namespace equipoise::model {

Drive prescribed_drive(const std::vector<Segment>& segments) {
  Drive drive;
  drive.psi = segments.front().psi;
  drive.speed = segments.front().speed;
  for (const Segment& s : segments) {
    drive.pieces.push_back({.begin = s.begin,
                            .end = s.end,
                            .prescribed = true,
                            .psi = s.psi,
                            .speed = s.speed,
                            .acceleration = s.acceleration,
                            .curve = s.curve});
    if (s.clamped) drive.release_time = s.end;
  }
  return drive;
}

Drive motor_drive(const MotorLaw& law, double psi, double speed) {
  Drive drive;
  drive.psi = psi;
  drive.speed = speed;
  for (const DriveSegment& s : drive_segments(law))
    drive.pieces.push_back({.begin = s.begin, .end = s.end, .prescribed = false, .motor = s});
  return drive;
}

}  // namespace equipoise::model
