// The equations as autonomous-looking systems (t, z) -> dz/dt over one segment of the rotor's motion.
// Included once per CPU target.
#if defined(EQUIPOISE_MODEL_FLOW_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_FLOW_INL
#undef EQUIPOISE_MODEL_FLOW_INL
#else
#define EQUIPOISE_MODEL_FLOW_INL
#endif

#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/speed.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// psi', psi'' and, where the terms need it, sin psi and cos psi at a time within one segment.
template <class T, Terms terms>
class SegmentMotion {
 public:
  explicit SegmentMotion(const model::Segment& s)
      : begin_(s.begin), psi_(s.psi), speed_(s.speed), acceleration_(s.acceleration) {}

  HWY_INLINE RotorMotion<T> at(const T& t) const {
    RotorMotion<T> rotor;
    rotor.speed = speed_;
    if constexpr (terms.acceleration) {
      rotor.speed = multiply_add(acceleration_, t - begin_, speed_);
      rotor.acceleration = acceleration_;
    }
    if constexpr (terms.anisotropy || terms.gravity) {
      const T tau = t - begin_;
      T angle = speed_;
      if constexpr (terms.acceleration) angle = multiply_add(T(0.5) * acceleration_, tau, angle);
      sin_cos(multiply_add(angle, tau, psi_), rotor.sin_psi, rotor.cos_psi);
    }
    return rotor;
  }

 private:
  T begin_, psi_, speed_, acceleration_;
};

// Balls free. State: model/parameters.hpp.
template <class T, int room, Terms terms>
class FreeFlow {
 public:
  static constexpr int dimension = model::dimension(room);  // the largest size

  FreeFlow(const model::Parameters& p, const model::Segment& s) : balls_(p.balls), balancer_(p), motion_(s) {}

  // Of a state: a constant unless there is room for any count of balls.
  HWY_INLINE auto size() const { return balls_.size(); }

  HWY_INLINE void operator()(const T& t, const T* z, T* dz) const { balancer_.free_derivative(motion_.at(t), z, dz); }

 private:
  model::BallCount<room> balls_;
  BallBalancer<T, room, terms> balancer_;
  SegmentMotion<T, terms> motion_;
};

// Balls clamped: three solutions (x, y, u, v) side by side, from which every clamped motion is
// z = z0 + Ux z1 + Uy z2 with the unbalance U = lambda + sum mu_i e^{i phi_i}. z0 carries the initial state and
// gravity; z1 and z2 start at rest with U = (1, 0) and (0, 1).
class ClampedBasisFlow {
 public:
  static constexpr int dimension = 12;
  static constexpr Terms terms{};

  ClampedBasisFlow(const model::Parameters& p, const model::Segment& s)
      : balancer_(p), motion_(s), gravity_(p.gravity) {}

  void operator()(double t, const double* z, double* dz) const {
    const RotorMotion<double> rotor = motion_.at(t);
    balancer_.clamped_derivative(rotor, {0.0, 0.0}, gravity_, z, dz);
    balancer_.clamped_derivative(rotor, {1.0, 0.0}, 0.0, z + 4, dz + 4);
    balancer_.clamped_derivative(rotor, {0.0, 1.0}, 0.0, z + 8, dz + 8);
  }

 private:
  // The count of balls enters only through the total mass, which the balancer takes from the parameters.
  BallBalancer<double, 1, terms> balancer_;
  SegmentMotion<double, terms> motion_;
  double gravity_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
