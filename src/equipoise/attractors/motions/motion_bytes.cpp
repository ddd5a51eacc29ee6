// Whether a motion from a file can be one of a system.
#include "equipoise/attractors/motions/motion_bytes.hpp"

#include <algorithm>

namespace equipoise {

namespace {

// Numbers of balls, or of groups of them.
template <class Numbers>
bool within(const Numbers& numbers, int least, int most) {
  return std::all_of(numbers.begin(), numbers.end(), [&](int n) { return n >= least && n <= most; });
}

}  // namespace

bool fits_system(const model::System& system, const PeriodicOrbit& orbit) {
  const auto size = static_cast<Eigen::Index>(system.dimension());
  constexpr int most_turns = 1'000'000;
  return orbit.multipliers.size() <= size && within(orbit.winding, -most_turns, most_turns) &&
         std::all_of(orbit.nodes.begin(), orbit.nodes.end(), [&](const auto& z) { return z.size() == size; });
}

bool fits_system(const model::System& system, Motion& m) {
  const auto size = static_cast<Eigen::Index>(system.dimension());
  const int balls = system.balls();
  if (m.state.size() != size || m.spectrum.size() > size || m.exponents.size() > static_cast<std::size_t>(size))
    return false;
  if (!fits_system(system, m.orbit) || (m.kind == MotionKind::periodic && !m.eventful && m.orbit.nodes.empty()))
    return false;
  if (!within(m.cluster, 0, balls) || !within(m.drift_group, 0, balls)) return false;
  if (!within(m.mode.order, 0, std::max(balls - 1, 0)) || !within(m.mode.sense, -1, 1)) return false;
  for (const BallEvent& e : m.events)
    if (e.ball < 0 || e.ball >= balls || e.other < -1 || e.other >= balls) return false;
  if (m.motor.has_value() != !system.prescribed()) return false;
  if (m.motor) m.motor->drive = system.drive();
  return true;
}

}  // namespace equipoise
