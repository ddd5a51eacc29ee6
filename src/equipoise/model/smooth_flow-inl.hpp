// The equations of any smooth system (t, y) -> dy/dt in the state of model/system.hpp: a motor or a prescribed speed,
// the race off the shaft's centre or not. Rotors at a prescribed speed whose race is centred have FreeFlow, which costs
// less. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_SMOOTH_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#undef EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#else
#define EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#endif

#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/drive-inl.hpp"
#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/held_state.hpp"
#include "equipoise/model/system.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <class T, int room>
class SmoothFlow {
 public:
  static constexpr int dimension = model::dimension(room) + 4;  // of the largest state, and one to make it even
  static constexpr int least_size = model::least_dimension<room>;

  // In the last piece of the drive, which no more depends on time. `psi`: the rotor's angle at time 0, where it is no
  // part of the state.
  SmoothFlow(const model::System& s, double psi) : SmoothFlow(s, 0.0, psi) {}
  // Over the piece of a drive that the system holds, in study time. `segment` says when that begins, and with which
  // angle if the rotor turns as prescribed.
  SmoothFlow(const model::System& s, const model::Segment& segment) : SmoothFlow(s, segment.begin, segment.psi) {}

  int size() const { return drive_.layout().size; }

  HWY_INLINE void operator()(const T& t, const T* y, T* dy) const {
    const RotorMotion<T> rotor = drive_.rotor(t, y);
    const MotorState<T> motor = drive_.motor(t, rotor, y);
    const BodyResult<T> result = balancer_.body_derivative(rotor, drive_.driven() ? &motor.torque : nullptr, y, dy);
    drive_.rates(rotor, result.acceleration, motor.error_rate, dy);
  }

  // Lane `lane` gets the rotor and the piece of a drive of `from`, in a state of the same size.
  void take_lane(const SmoothFlow& from, int lane) {
    balancer_.take_lane(from.balancer_, lane);
    drive_.take_lane(from.drive_, lane);
  }

 private:
  SmoothFlow(const model::System& s, double begin, double psi)
      : balancer_(s.parameters()), drive_(s.parameters(), s.drive(), s.layout(), begin, psi) {}

  BallBalancer<T, room, Terms{true, true, true, true}> balancer_;
  RotorDrive<T> drive_;
};

// A rotor whose balls are held: one body, whose unbalance is part of the state and stays what it is. State: x, y, u, v;
// sum mu_i e^{i phi_i} of the balls, x and y; then what the system has of psi, psi' and the speed error.
template <class T>
class HeldFlow {
 public:
  static constexpr int dimension = model::dimension(1) + 4, least_size = model::dimension(1);

  // Over the piece of a drive that the system holds, in study time.
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
