// What drives the rotor at one instant, for every number type: psi', psi'' or the motor's torque, and their rates where
// they are part of the state. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_DRIVE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_DRIVE_INL
#undef EQUIPOISE_MODEL_DRIVE_INL
#else
#define EQUIPOISE_MODEL_DRIVE_INL
#endif

#include <cmath>

#include "equipoise/math/dual.hpp"
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

// Over one piece of a drive, in study time. Rotor angle, speed and speed error stand at `places`; `begin`: of the
// piece, and `psi` the angle there, where it is no part of the state.
template <class T>
class RotorDrive {
 public:
  RotorDrive(const model::Parameters& p, const model::DrivePiece& piece, model::DrivePlaces places, double begin,
             double psi)
      : piece_(piece), places_(places), turning_(model::is_strobed(p)), begin_(begin), psi_(psi) {}

  void enter(const model::DrivePiece& piece) {
    piece_ = piece;
    begin_ = piece.begin;
    psi_ = piece.psi;
  }

  bool driven() const { return !piece_.prescribed; }
  const model::DrivePlaces& places() const { return places_; }

  HWY_INLINE RotorMotion<T> rotor(const T& t, const T* y) const {
    const T elapsed = t - T(begin_);
    const T prescribed = T(piece_.speed) + T(piece_.acceleration) * elapsed;
    RotorMotion<T> rotor{places_.speed < 0 ? prescribed : y[places_.speed], T(piece_.acceleration), T(0.0), T(1.0)};
    if (!turning_) return rotor;
    const T mean = T(0.5) * (T(piece_.speed) + prescribed);
    const T angle = places_.psi < 0 ? T(psi_) + mean * elapsed : y[places_.psi];
    sin_cos(angle, rotor.sin_psi, rotor.cos_psi);
    return rotor;
  }

  // Of a driven rotor.
  HWY_INLINE MotorState<T> motor(const T& t, const RotorMotion<T>& rotor, const T* y) const {
    if (!driven()) return {};
    return motor_state(piece_.motor, t - T(begin_), rotor.speed, places_.error < 0 ? T(0.0) : y[places_.error]);
  }

  HWY_INLINE void rates(const RotorMotion<T>& rotor, const T& acceleration, const T& error_rate, T* dy) const {
    if (places_.psi >= 0) dy[places_.psi] = rotor.speed;
    if (places_.speed >= 0) dy[places_.speed] = acceleration;
    if (places_.error >= 0) dy[places_.error] = error_rate;
  }

 private:
  model::DrivePiece piece_;
  model::DrivePlaces places_;
  bool turning_;
  double begin_, psi_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
