// The members of a motion, for search logs.
#pragma once

#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/bytes.hpp"

namespace equipoise {

template <class Bytes, Like<PeriodicOrbit> T>
void members(Bytes& b, T& o) {
  b(o.period, o.winding, o.nodes, o.multipliers, o.residual, o.imposed);
}

constexpr MotionKind last_of(MotionKind) { return MotionKind::measured; }
constexpr BallEventKind last_of(BallEventKind) { return BallEventKind::turn; }

template <class Bytes, Like<BallEvent> T>
void members(Bytes& b, T& e) {
  b(e.time, e.kind, e.ball, e.other);
}

template <class Bytes, Like<model::BallMode> T>
void members(Bytes& b, T& m) {
  b(m.held, m.sense, m.joined, m.order, m.turns);
}

template <class Bytes, Like<Motion> T>
void members(Bytes& b, T& m) {
  b(m.kind, m.speed, m.motor, m.state, m.period, m.winding, m.drift, m.rate_min, m.rate_max, m.r_min, m.r_mean,
    m.r_max);
  b(m.spectrum, m.exponents, m.stable, m.residual, m.orbit, m.depends_on_angle, m.sections, m.balanced, m.duration);
  b(m.mode, m.events, m.eventful, m.stuck, m.set_valued);
  b(m.cluster, m.together, m.oppositions_per_turn, m.drift_group, m.half_period_exchange, m.copies);
}

/// Whether a motion that was read can be one of this system: lengths, and numbers of balls. What drives the rotor is
/// taken from the system.
bool fits_system(const model::System& system, Motion& motion);
bool fits_system(const model::System& system, const PeriodicOrbit& orbit);

}  // namespace equipoise
