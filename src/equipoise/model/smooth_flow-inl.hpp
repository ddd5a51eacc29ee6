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
#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/strobe.hpp"
#include "equipoise/model/system.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// A motor's torque and the rate of the integral of its speed error.
template <class T>
struct MotorState {
  T torque, error_rate;
};

inline MotorState<double> motor_state(const model::DriveSegment& motor, const double& speed, const double& error) {
  return {motor.torque(motor.begin, speed, error), motor.error_rate(motor.begin, speed, error)};
}

// With their slopes; where the torque is cut at the motor's limit it has none.
template <int slopes>
MotorState<Dual<slopes>> motor_state(const model::DriveSegment& motor, const Dual<slopes>& speed,
                                     const Dual<slopes>& error) {
  MotorState<Dual<slopes>> result;
  result.torque = motor.torque(motor.begin, speed.value, error.value);
  result.error_rate = motor.error_rate(motor.begin, speed.value, error.value);
  const bool cut = std::fabs(result.torque.value) >= motor.limit;
  for (int k = 0; k < slopes; ++k) {
    if (!cut) result.torque.slope[k] = motor.slope * speed.slope[k] + motor.integral * error.slope[k];
    if (!cut && motor.integral != 0.0) result.error_rate.slope[k] = -speed.slope[k];
  }
  return result;
}

// Where psi, psi' and the speed error's integral stand in a state; -1: nowhere.
struct DrivePlaces {
  int psi = -1, speed = -1, error = -1;
};

template <class T, int room>
class SmoothFlow {
 public:
  static constexpr int dimension = model::dimension(room) + 3;  // of the largest state

  // `psi`: the rotor's angle at time 0, where it is no part of the state.
  SmoothFlow(const model::System& s, double psi)
      : balancer_(s.parameters()),
        drive_(s.drive()),
        places_{s.psi_place(), s.speed_place(), s.error_place()},
        turning_(model::is_strobed(s.parameters())),
        psi_(psi) {}

  void operator()(const T& t, const T* y, T* dy) const {
    RotorMotion<T> rotor{places_.speed < 0 ? T(drive_.speed) : y[places_.speed], T(0.0), T(0.0), T(1.0)};
    if (turning_) {
      const T angle = places_.psi < 0 ? T(psi_) + rotor.speed * t : y[places_.psi];
      sin_cos(angle, rotor.sin_psi, rotor.cos_psi);
    }
    MotorState<T> motor{};
    const bool driven = !drive_.prescribed;
    if (driven) motor = motor_state(drive_.motor, rotor.speed, places_.error < 0 ? T(0.0) : y[places_.error]);
    const BodyResult<T> result = balancer_.body_derivative(rotor, driven ? &motor.torque : nullptr, y, dy);
    if (places_.psi >= 0) dy[places_.psi] = rotor.speed;
    if (places_.speed >= 0) dy[places_.speed] = result.acceleration;
    if (places_.error >= 0) dy[places_.error] = motor.error_rate;
  }

 private:
  BallBalancer<T, room, Terms{true, true, true, true}> balancer_;
  model::DrivePiece drive_;
  DrivePlaces places_;
  bool turning_;
  double psi_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
