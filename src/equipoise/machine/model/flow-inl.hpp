// The equations as flows (t, z) -> dz/dt over one segment of the rotor's prescribed motion.
// Included once per CPU target.
#if defined(EQUIPOISE_MODEL_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_FLOW_INL
#undef EQUIPOISE_MODEL_FLOW_INL
#else
#define EQUIPOISE_MODEL_FLOW_INL
#endif

#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/equations-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// psi', psi'' and, if the terms need them, sin psi and cos psi at a time within one segment.
template <class T, Terms terms>
class SegmentMotion {
 public:
  explicit SegmentMotion(const model::Segment& s)
      : begin_(s.begin), psi_(s.psi), speed_(s.speed), acceleration_(s.acceleration), curve_(s.curve) {}

  HWY_INLINE RotorMotion<T> at(const T& t) const {
    RotorMotion<T> rotor;
    rotor.speed = speed_;
    if constexpr (terms.acceleration) {
      rotor.speed = multiply_add(acceleration_, t - begin_, speed_);
      rotor.acceleration = acceleration_;
      if (curve_.present()) {
        rotor.speed = rotor.speed + curve_.speed(t - begin_);
        rotor.acceleration = rotor.acceleration + curve_.acceleration(t - begin_);
      }
    }
    if constexpr (terms.anisotropy || terms.gravity) {
      const T tau = t - begin_;
      T angle = speed_;
      if constexpr (terms.acceleration) angle = multiply_add(T(0.5) * acceleration_, tau, angle);
      angle = multiply_add(angle, tau, psi_);
      if constexpr (terms.acceleration)
        if (curve_.present()) angle = angle + curve_.angle(tau);
      sin_cos(angle, rotor.sin_psi, rotor.cos_psi);
    }
    return rotor;
  }

  void take_lane(const SegmentMotion& from, int lane) {
    using M = SegmentMotion;
    take_lane_of(*this, from, lane, &M::begin_, &M::psi_, &M::speed_, &M::acceleration_);
    curve_.take_lane(from.curve_, lane);
  }

 private:
  T begin_, psi_, speed_, acceleration_;
  CurveMotion<T> curve_;
};

// Balls free. State: machine/model/parameters.hpp.
template <class T, int room, Terms terms>
class FreeFlow {
 public:
  static constexpr int dimension = model::dimension(room);  // the largest size
  static constexpr int least_size = model::least_dimension<room>;

  FreeFlow(const model::Parameters& p, const model::Segment& s) : balls_(p.balls), balancer_(p), motion_(s) {}

  // Size of a state: a constant unless `room` is any_count.
  HWY_INLINE auto size() const { return balls_.size(); }

  HWY_INLINE void operator()(const T& t, const T* z, T* dz) const { balancer_.free_derivative(motion_.at(t), z, dz); }

  // Copies the rotor and the segment of `from` into lane `lane`.
  void take_lane(const FreeFlow& from, int lane) {
    balancer_.take_lane(from.balancer_, lane);
    motion_.take_lane(from.motion_, lane);
  }

 private:
  model::BallCount<room> balls_;
  BallBalancer<T, room, terms> balancer_;
  SegmentMotion<T, terms> motion_;
};

// Balls clamped: rotor and balls are one body, and ball angles enter only through its unbalance.
class ClampedBody {
 public:
  ClampedBody(const model::Parameters& p, double gravity)
      : balancer_(centred(p, gravity)), mass_(1.0 + p.total_mass()) {}

  // d/dt of (x, y, u, v) with the unbalance U = lambda + sum mu_i e^{i phi_i}: linear in the state, U and gravity, so
  // solutions superpose.
  void derivative(const RotorMotion<double>& rotor, const Vector2<double>& unbalance, const double* z,
                  double* dz) const {
    constexpr double unasked = 0.0;  // a prescribed motion does not depend on inertia
    balancer_.body_derivative(rotor, {unbalance, mass_, unasked}, nullptr, z, dz);
  }

 private:
  static model::Parameters centred(model::Parameters p, double gravity) {
    p.race_offset = {0.0, 0.0};  // U is taken from the shaft's centre
    p.gravity = gravity;
    return p;
  }

  BallBalancer<double, 0, Terms{true, true, true, true}> balancer_;
  double mass_;
};

// Three solutions (x, y, u, v) side by side, from which every clamped motion is z = z0 + Ux z1 + Uy z2. z0 carries the
// initial state and gravity; z1 and z2 start at rest with U = (1, 0) and (0, 1).
class ClampedBasisFlow {
 public:
  static constexpr int dimension = 12;

  ClampedBasisFlow(const model::Parameters& p, const model::Segment& s)
      : heavy_(p, p.gravity), weightless_(p, 0.0), motion_(s) {}

  void operator()(double t, const double* z, double* dz) const {
    const RotorMotion<double> rotor = motion_.at(t);
    heavy_.derivative(rotor, {0.0, 0.0}, z, dz);
    weightless_.derivative(rotor, {1.0, 0.0}, z + 4, dz + 4);
    weightless_.derivative(rotor, {0.0, 1.0}, z + 8, dz + 8);
  }

 private:
  ClampedBody heavy_, weightless_;
  SegmentMotion<double, Terms{}> motion_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
