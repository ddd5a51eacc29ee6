// The rotor's drive at one instant, for every number type: psi', psi'' or the motor's torque, and the rates of those
// that the state holds. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_DRIVE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_DRIVE_INL
#undef EQUIPOISE_MODEL_DRIVE_INL
#else
#define EQUIPOISE_MODEL_DRIVE_INL
#endif

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"
#include "equipoise/machine/model/system.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// The torque on the rotor, the rate of the motor's speed error's integral, `elapsed` after the piece of its law began,
// and the torque that the load takes: the motor gives both torques together.
template <class T>
struct MotorState {
  T torque, error_rate;
  T taken = T(0.0);
};

inline MotorState<double> motor_state(const model::DriveSegment& motor, const double& elapsed, const double& speed,
                                      const double& error) {
  const double t = motor.begin + elapsed;
  return {motor.torque(t, speed, error), motor.error_rate(t, speed, error), motor.load(speed)};
}

// For dual numbers, with their slopes; a torque cut at the motor's limit has slope 0.
template <class T>
requires(!std::is_same_v<T, double> && std::is_same_v<decltype(T::value), double>)
    MotorState<T> motor_state(const model::DriveSegment& motor, const T& elapsed, const T& speed, const T& error) {
  const MotorState<double> here = motor_state(motor, elapsed.value, speed.value, error.value);
  const bool cut = std::fabs(here.torque + here.taken) >= motor.limit;
  const double slope = cut ? 0.0 : motor.slope + motor.bends.slope(speed.value), taken = motor.load.slope(speed.value);
  MotorState<T> result{T(slope - taken) * speed, T(0.0), T(taken) * speed};
  if (!cut && motor.integral != 0.0) {
    result.torque = result.torque + T(motor.integral) * error;
    result.error_rate = -speed;
  }
  result.torque.value = here.torque;
  result.error_rate.value = here.error_rate;
  result.taken.value = here.taken;
  return result;
}

// One motor law per lane.
struct MotorLanes {
  explicit MotorLanes(const model::DriveSegment& m)
      : constant(m.constant),
        slope(m.slope),
        rate(m.rate),
        integral(m.integral),
        aim(m.aim),
        aim_rate(m.aim_rate),
        limit(m.limit),
        load_constant(m.load.constant),
        load_linear(m.load.linear),
        load_quadratic(m.load.quadratic),
        integrates(m.integral != 0.0),
        loads(!m.load.is_none()),
        bends(m.bends.count) {
    for (int k = 0; k < model::Bends::most; ++k) {
      at[k] = Pack(m.bends.at[k]);
      by[k] = Pack(m.bends.by[k]);
    }
  }

  void take_lane(const MotorLanes& from, int lane) {
    using M = MotorLanes;
    take_lane_of(*this, from, lane, &M::constant, &M::slope, &M::rate, &M::integral, &M::aim, &M::aim_rate, &M::limit,
                 &M::load_constant, &M::load_linear, &M::load_quadratic, &M::at, &M::by);
    integrates = integrates || from.integrates;
    loads = loads || from.loads;
    bends = std::max(bends, from.bends);  // a lane's bends beyond its own are by 0
  }

  Pack constant, slope, rate, integral, aim, aim_rate, limit, load_constant, load_linear, load_quadratic;
  bool integrates, loads;
  int bends;
  Pack at[model::Bends::most], by[model::Bends::most];
};

HWY_INLINE MotorState<Pack> motor_state(const MotorLanes& motor, const Pack& elapsed, const Pack& speed,
                                        const Pack& error) {
  const Pack &limit = motor.limit, zero(0.0);
  Pack uncut = motor.constant + motor.rate * elapsed + motor.slope * speed + motor.integral * error;
  for (int k = 0; k < motor.bends; ++k) uncut = uncut + motor.by[k] * maximum(zero, speed - motor.at[k]);
  MotorState<Pack> result{minimum(maximum(uncut, -limit), limit), zero, zero};
  if (motor.loads) {
    const Pack one(1.0), crept = speed * Pack(1.0 / model::Load::creeping);
    result.taken = motor.load_constant * minimum(maximum(crept, -one), one) +
                   (motor.load_linear + motor.load_quadratic * absolute(speed)) * speed;
    result.torque = result.torque - result.taken;
  }
  if (!motor.integrates) return result;
  const Pack lag = motor.aim + motor.aim_rate * elapsed - speed, push = lag * motor.integral;
  const Mask cut_further = ((limit < uncut) & (zero < push)) | ((uncut < -limit) & (push < zero));
  result.error_rate = select(cut_further, zero, lag);
  return result;
}

// Over one piece of a drive, in study time. `layout` says where rotor angle, speed and speed error are in the state;
// `begin`: of the piece, and `psi` the angle there, if it is not part of the state.
template <class T>
class RotorDrive {
 public:
  RotorDrive(const model::Parameters& p, const model::DrivePiece& piece, const model::StateLayout& layout, double begin,
             double psi)
      : layout_(layout), turning_(model::depends_on_rotor_angle(p)), motor_(piece.motor), curve_(piece.curve) {
    enter(piece, begin, psi);
  }

  void enter(const model::DrivePiece& piece) { enter(piece, piece.begin, piece.psi); }

  // Lane `lane` gets the drive of `from`: its kind and layout must be the same.
  void take_lane(const RotorDrive& from, int lane) {
    using D = RotorDrive;
    take_lane_of(*this, from, lane, &D::begin_, &D::psi_, &D::speed_, &D::acceleration_);
    motor_.take_lane(from.motor_, lane);
    curve_.take_lane(from.curve_, lane);
  }

  bool driven() const { return driven_; }
  const model::StateLayout& layout() const { return layout_; }

  HWY_INLINE RotorMotion<T> rotor(const T& t, const T* y) const {
    const T elapsed = t - begin_;
    const T prescribed = speed_ + acceleration_ * elapsed;
    RotorMotion<T> rotor{layout_.speed < 0 ? prescribed : y[layout_.speed], acceleration_, T(0.0), T(1.0)};
    if (curve_.present()) {
      if (layout_.speed < 0) rotor.speed = rotor.speed + curve_.speed(elapsed);
      rotor.acceleration = rotor.acceleration + curve_.acceleration(elapsed);
    }
    if (!turning_) return rotor;
    const T mean = T(0.5) * (speed_ + prescribed);
    T angle = layout_.psi < 0 ? psi_ + mean * elapsed : y[layout_.psi];
    if (curve_.present() && layout_.psi < 0) angle = angle + curve_.angle(elapsed);
    sin_cos(angle, rotor.sin_psi, rotor.cos_psi);
    return rotor;
  }

  // Meaningful only if driven().
  HWY_INLINE MotorState<T> motor(const T& t, const RotorMotion<T>& rotor, const T* y) const {
    if (!driven()) return {};
    return motor_state(motor_, t - begin_, rotor.speed, layout_.error < 0 ? T(0.0) : y[layout_.error]);
  }

  HWY_INLINE void rates(const RotorMotion<T>& rotor, const T& acceleration, const T& error_rate, T* dy) const {
    if (layout_.psi >= 0) dy[layout_.psi] = rotor.speed;
    if (layout_.speed >= 0) dy[layout_.speed] = acceleration;
    if (layout_.error >= 0) dy[layout_.error] = error_rate;
  }

 private:
  void enter(const model::DrivePiece& piece, double begin, double psi) {
    driven_ = !piece.prescribed;
    motor_ = Motor(piece.motor);
    curve_ = CurveMotion<T>(piece.curve);
    begin_ = T(begin);
    psi_ = T(psi);
    speed_ = T(piece.speed);
    acceleration_ = T(piece.acceleration);
  }

  using Motor = std::conditional_t<std::is_same_v<T, Pack>, MotorLanes, model::DriveSegment>;

  model::StateLayout layout_;
  bool turning_, driven_ = false;
  Motor motor_;
  CurveMotion<T> curve_;
  T begin_, psi_, speed_, acceleration_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
