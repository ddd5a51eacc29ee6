// The equations of any smooth system (t, y) -> dy/dt in the state of machine/model/system.hpp: with a motor or a
// prescribed speed, with a centred or an off-centre race. At a prescribed speed with a centred race FreeFlow costs
// less. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_SMOOTH_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#undef EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#else
#define EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#endif

#include <type_traits>

#include "equipoise/machine/model/ball_count.hpp"
#include "equipoise/machine/model/drive-inl.hpp"
#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/held_state.hpp"
#include "equipoise/machine/model/system.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <class T, int room, bool tilt = false>
class SmoothFlow {
 public:
  // Of the largest state, padded to an even number.
  static constexpr int dimension = model::dimension(room) + (tilt ? 8 : 4);
  static constexpr int least_size = model::least_dimension<room>;

  // For the last piece of the drive, which no longer depends on time. `psi`: the rotor's angle at time 0, unless the
  // state holds it.
  SmoothFlow(const model::System& s, double psi) : SmoothFlow(s, 0.0, psi) {}
  // For the system's piece of its drive, in study time. `segment` says when the piece begins and, if the rotor turns as
  // prescribed, at which angle.
  SmoothFlow(const model::System& s, const model::Segment& segment) : SmoothFlow(s, segment.begin, segment.psi) {}

  int size() const { return drive_.layout().size; }

  HWY_INLINE void operator()(const T& t, const T* y, T* dy) const {
    const RotorMotion<T> rotor = drive_.rotor(t, y);
    const MotorState<T> motor = drive_.motor(t, rotor, y);
    const BodyResult<T> result = balancer_.body_derivative(rotor, drive_.driven() ? &motor.torque : nullptr, y, dy);
    drive_.rates(rotor, result.acceleration, motor.error_rate, dy);
  }

  // Copies rotor and drive of `from`, with a state of the same size, into lane `lane`.
  void take_lane(const SmoothFlow& from, int lane) {
    balancer_.take_lane(from.balancer_, lane);
    drive_.take_lane(from.drive_, lane);
  }

 private:
  SmoothFlow(const model::System& s, double begin, double psi)
      : balancer_(s.parameters(), s.layout().tilt), drive_(s.parameters(), s.drive(), s.layout(), begin, psi) {}

  BallBalancer<T, room, body_terms(tilt)> balancer_;
  RotorDrive<T> drive_;
};

// Calls `f(std::bool_constant<tilt>{})`: code for tilting rotors is apart from that of all others.
template <class F>
decltype(auto) with_tilt(const model::System& system, F&& f) {
  return system.tilts() ? f(std::true_type{}) : f(std::false_type{});
}

// A rotor whose balls are held: one body, whose constant unbalance is part of the state (machine/model/held_state.hpp).
template <class T>
class HeldFlow {
 public:
  static constexpr int dimension = model::dimension(1) + 4, least_size = model::dimension(1);

  // For the system's piece of its drive, in study time.
  explicit HeldFlow(const model::System& s)
      : balancer_(s.parameters()),
        drive_(s.parameters(), s.drive(), model::held_layout(s), s.drive().begin, s.drive().psi) {
    const model::Parameters& p = s.parameters();
    const double x = p.eccentricity - p.race_offset[0], y = -p.race_offset[1];
    double inertia = p.inertia + x * x + y * y;
    const double spin = p.rolls ? model::sphere_inertia.value() : 0.0;
    for (int i = 0; i < p.balls; ++i) inertia += p.mass[i] * (1.0 + spin * p.ball_radius[i] * p.ball_radius[i]);
    rotor_ = {{T(x), T(y)}, T(1.0 + p.total_mass()), T(inertia)};
  }

  int size() const { return drive_.layout().size; }

  HWY_INLINE void operator()(const T& t, const T* y, T* dy) const {
    const RotorMotion<T> rotor = drive_.rotor(t, y);
    const MotorState<T> motor = drive_.motor(t, rotor, y);
    Body<T> body = rotor_;
    body.unbalance = {body.unbalance.x + y[4], body.unbalance.y + y[5]};
    const BodyResult<T> result =
        balancer_.body_derivative(rotor, body, drive_.driven() ? &motor.torque : nullptr, y, dy);
    dy[4] = dy[5] = T(0.0);
    drive_.rates(rotor, result.acceleration, motor.error_rate, dy);
  }

  void take_lane(const HeldFlow& from, int lane) {
    balancer_.take_lane(from.balancer_, lane);
    drive_.take_lane(from.drive_, lane);
    equipoise::HWY_NAMESPACE::take_lane(rotor_, from.rotor_, lane);
  }

 private:
  BallBalancer<T, 0, Terms{true, true, true, true}> balancer_;
  RotorDrive<T> drive_;
  Body<T> rotor_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
