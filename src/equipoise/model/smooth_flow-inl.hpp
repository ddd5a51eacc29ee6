// The equations of any smooth system (t, y) -> dy/dt in the state of model/system.hpp: a motor or a prescribed speed,
// the race off the shaft's centre or not. Rotors at a prescribed speed whose race is centred have FreeFlow, which costs
// less. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_SMOOTH_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#undef EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#else
#define EQUIPOISE_MODEL_SMOOTH_FLOW_INL
#endif

#include <cmath>

#include "equipoise/math/dual.hpp"
#include "equipoise/model/ball_count.hpp"
#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A motor's torque and the rate of the integral of its speed error, `elapsed` after its piece of the law began.
template <class T>
struct MotorState {
  T torque, error_rate;
};

inline MotorState<double> motor_state(const model::DriveSegment& motor, const double& elapsed, const double& speed,
                                      const double& error) {
  const double t = motor.begin + elapsed;
  return {motor.torque(t, speed, error), motor.error_rate(t, speed, error)};
}

// With their slopes; where the torque is cut at the motor's limit it has none.
template <int slopes>
MotorState<Dual<slopes>> motor_state(const model::DriveSegment& motor, const Dual<slopes>& elapsed,
                                     const Dual<slopes>& speed, const Dual<slopes>& error) {
  const MotorState<double> here = motor_state(motor, elapsed.value, speed.value, error.value);
  MotorState<Dual<slopes>> result;
  result.torque = here.torque;
  result.error_rate = here.error_rate;
  const bool cut = std::fabs(result.torque.value) >= motor.limit;
  for (int k = 0; k < slopes; ++k) {
    if (!cut) result.torque.slope[k] = motor.slope * speed.slope[k] + motor.integral * error.slope[k];
    if (!cut && motor.integral != 0.0) result.error_rate.slope[k] = -speed.slope[k];
  }
  return result;
}

HWY_INLINE MotorState<Pack> motor_state(const model::DriveSegment& motor, const Pack& elapsed, const Pack& speed,
                                        const Pack& error) {
  const Pack uncut =
      Pack(motor.constant) + Pack(motor.rate) * elapsed + Pack(motor.slope) * speed + Pack(motor.integral) * error;
  const Pack limit(motor.limit), zero(0.0);
  MotorState<Pack> result{minimum(maximum(uncut, -limit), limit), zero};
  if (motor.integral == 0.0) return result;
  const Pack lag = Pack(motor.aim) + Pack(motor.aim_rate) * elapsed - speed, push = lag * Pack(motor.integral);
  const Mask cut_further = ((limit < uncut) & (zero < push)) | ((uncut < -limit) & (push < zero));
  result.error_rate = select(cut_further, zero, lag);
  return result;
}

// Where psi, psi' and the speed error's integral stand in a state; -1: nowhere.
struct DrivePlaces {
  int psi = -1, speed = -1, error = -1;
};

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

  int size() const { return size_; }

  HWY_INLINE void operator()(const T& t, const T* y, T* dy) const {
    const T elapsed = t - T(begin_);
    const T prescribed = T(drive_.speed) + T(drive_.acceleration) * elapsed;
    RotorMotion<T> rotor{places_.speed < 0 ? prescribed : y[places_.speed], T(drive_.acceleration), T(0.0), T(1.0)};
    if (turning_) {
      const T mean = T(0.5) * (T(drive_.speed) + prescribed);
      const T angle = places_.psi < 0 ? T(psi_) + mean * elapsed : y[places_.psi];
      sin_cos(angle, rotor.sin_psi, rotor.cos_psi);
    }
    MotorState<T> motor{};
    const bool driven = !drive_.prescribed;
    if (driven) motor = motor_state(drive_.motor, elapsed, rotor.speed, places_.error < 0 ? T(0.0) : y[places_.error]);
    const BodyResult<T> result = balancer_.body_derivative(rotor, driven ? &motor.torque : nullptr, y, dy);
    if (places_.psi >= 0) dy[places_.psi] = rotor.speed;
    if (places_.speed >= 0) dy[places_.speed] = result.acceleration;
    if (places_.error >= 0) dy[places_.error] = motor.error_rate;
  }

 private:
  SmoothFlow(const model::System& s, double begin, double psi)
      : balancer_(s.parameters()),
        drive_(s.drive()),
        places_{s.psi_place(), s.speed_place(), s.error_place()},
        size_(s.dimension()),
        turning_(model::is_strobed(s.parameters())),
        begin_(begin),
        psi_(psi) {}

  BallBalancer<T, room, Terms{true, true, true, true}> balancer_;
  model::DrivePiece drive_;
  DrivePlaces places_;
  int size_;
  bool turning_;
  double begin_, psi_;
};

// A driven rotor whose balls are held: one body, whose unbalance is part of the state and stays what it is. State: x,
// y, u, v; sum mu_i e^{i phi_i} of the balls, x and y; then what the system has of psi, psi' and the speed error.
template <class T>
class HeldFlow {
 public:
  static constexpr int dimension = model::dimension(1) + 4, least_size = model::dimension(1);

  // Over the piece of a drive that the system holds, in study time.
  explicit HeldFlow(const model::System& s)
      : balancer_(s.parameters()),
        drive_(s.drive()),
        size_(model::dimension(1) + s.dimension() - model::dimension(s.balls())),
        turning_(model::is_strobed(s.parameters())) {
    const model::Parameters& p = s.parameters();
    const int shift = model::dimension(1) - model::dimension(p.balls);
    const auto moved = [&](int place) { return place < 0 ? -1 : place + shift; };
    places_ = {moved(s.psi_place()), moved(s.speed_place()), moved(s.error_place())};
    const double x = p.eccentricity - p.race_offset[0], y = -p.race_offset[1];
    double inertia = p.inertia + x * x + y * y;
    for (int i = 0; i < p.balls; ++i)
      inertia += p.mass[i] * (1.0 + (p.rolls ? 0.4 * p.ball_radius[i] * p.ball_radius[i] : 0.0));  // solid spheres
    rotor_ = {{T(x), T(y)}, T(1.0 + p.total_mass()), T(inertia)};
  }

  int size() const { return size_; }

  HWY_INLINE void operator()(const T& t, const T* y, T* dy) const {
    RotorMotion<T> rotor{y[places_.speed], T(0.0), T(0.0), T(1.0)};
    if (turning_) sin_cos(y[places_.psi], rotor.sin_psi, rotor.cos_psi);
    const T error = places_.error < 0 ? T(0.0) : y[places_.error];
    const MotorState<T> motor = motor_state(drive_.motor, t - T(drive_.begin), rotor.speed, error);
    Body<T> body = rotor_;
    body.unbalance = {body.unbalance.x + y[4], body.unbalance.y + y[5]};
    const BodyResult<T> result = balancer_.body_derivative(rotor, body, &motor.torque, y, dy);
    dy[4] = dy[5] = T(0.0);
    if (places_.psi >= 0) dy[places_.psi] = rotor.speed;
    dy[places_.speed] = result.acceleration;
    if (places_.error >= 0) dy[places_.error] = motor.error_rate;
  }

 private:
  BallBalancer<T, 0, Terms{true, true, true, true}> balancer_;
  model::DrivePiece drive_;
  DrivePlaces places_;
  int size_;
  bool turning_;
  Body<T> rotor_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
