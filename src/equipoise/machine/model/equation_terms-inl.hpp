// What goes into the equations of motion and what comes out: which terms are on, the rotor's motion, bodies and their
// unbalance, what acts on balls and on a bearing. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_EQUATION_TERMS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_EQUATION_TERMS_INL
#undef EQUIPOISE_MODEL_EQUATION_TERMS_INL
#else
#define EQUIPOISE_MODEL_EQUATION_TERMS_INL
#endif

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/bearings.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Terms beyond the isotropic horizontal rotor at constant speed with sliding balls. A term that is off leaves no
// operation behind.
struct Terms {
  bool acceleration = true;
  bool anisotropy = true;
  bool gravity = true;
  bool body = false;     // any body in the rotor's place: a race off its centre, balls that are part of it; a motor
  bool actions = false;  // balls may be held, resist rolling or push each other
  bool rolls = true;     // balls roll if the parameters say so
  bool tilt = false;     // the rotor tilts, and balls run in planes of their own (equation_constants-inl.hpp)
};

// Of any rotor at any drive, as a body; one that tilts has a centred race and sliding balls.
constexpr Terms body_terms(bool tilt, bool actions = false) {
  return {.acceleration = true,
          .anisotropy = true,
          .gravity = true,
          .body = true,
          .actions = actions,
          .rolls = !tilt,
          .tilt = tilt};
}

// Of the paper's rotor: isotropic and horizontal, its balls slide.
constexpr Terms paper_terms(bool acceleration) {
  return {.acceleration = acceleration, .anisotropy = false, .gravity = false, .rolls = false};
}

// The rotor at one instant: psi' and psi''; sin and cos of psi are read only with anisotropy or gravity.
template <class T>
struct RotorMotion {
  T speed, acceleration, sin_psi, cos_psi;
};

// Components along the rotating axes.
template <class T>
struct Vector2 {
  T x, y;
};

template <class T>
struct Matrix2 {
  T xx, xy, yx, yy;

  HWY_INLINE T determinant() const { return xx * yy - xy * yx; }
  // Determinant times inverse, times v.
  HWY_INLINE Vector2<T> adjugate(const Vector2<T>& v) const { return {yy * v.x - xy * v.y, xx * v.y - yx * v.x}; }
};

// What turns as one with the rotor: itself, and balls that are held.
template <class T>
struct Body {
  Vector2<T> unbalance;  // mass times place of the centre of mass, from the race's centre O'
  T mass, inertia;       // inertia: moment about O'
};

// What balls feel, each over its mass.
template <class T, int room>
struct BallForces {
  T normal[room];      // by which it presses on the race, outward positive
  T tangential[room];  // that would set it moving if it were at rest and alone
  T push[room];        // by which those that it is joined with change its rate; 0 for all others
};

// What acts on the balls of a machine at one instant.
template <class T, int room>
struct BallActions {
  MaskOf<T> held[room] = {};  // turns with the rotor: clamped, or at rest by stiction
  bool acted_on = true;       // else the next two are 0 for all balls
  T resistance[room] = {};    // rolling resistance over normal force, with the sign of the ball's rate
  T push[room] = {};          // along phi_i, from other balls: mu_i phi_i'' for a ball alone; they sum to 0
  // For touching balls that move as one; null: none do. Row i: for each ball of the group of ball i, its share of the
  // group's mass; for a ball alone, 1 for itself.
  const T (*together)[room] = nullptr;
  BallForces<T, room>* forces = nullptr;  // receives what balls feel, if given
};

// What a body's equations are solved for in addition to rates.
template <class T>
struct BodyResult {
  Vector2<T> race;  // acceleration of the race's centre, plus gravity
  T acceleration;   // psi''
  T torque;         // on the rotor: the motor's, or the one that the prescribed motion needs
};

// `of_rotor` plus sum mu_i e^{i phi_i} over n balls.
template <class T>
HWY_INLINE Vector2<T> sum_of_unbalances(Vector2<T> of_rotor, int n, const T* mass, const T* phi) {
  for (int i = 0; i < n; ++i) {
    T sine, cosine;
    sin_cos(phi[i], sine, cosine);
    of_rotor.x = multiply_add(mass[i], cosine, of_rotor.x);
    of_rotor.y = multiply_add(mass[i], sine, of_rotor.y);
  }
  return of_rotor;
}

// What bends the speed of a prescribed motion over one segment: model::SpeedCurve in numbers of type T.
template <class T>
class CurveMotion {
 public:
  explicit CurveMotion(const model::SpeedCurve& c) : present_(c.present()), rate_(c.rate) {
    for (int k = 0; k < terms; ++k) by_[k] = T(c.by[k]);
  }

  // For a lane without a curve every coefficient is 0.
  void take_lane(const CurveMotion& from, int lane) {
    take_lane_of(*this, from, lane, &CurveMotion::rate_, &CurveMotion::by_);
    present_ = present_ || from.present_;
  }

  bool present() const { return present_; }
  T speed(const T& tau) const {
    const T u = rate_ * tau;
    return u * sum(u, [](int) { return 1.0; });
  }
  T acceleration(const T& tau) const {
    return rate_ * sum(rate_ * tau, [](int k) { return k + 1.0; });
  }
  T angle(const T& tau) const {
    const T u = rate_ * tau;
    return tau * u * sum(u, [](int k) { return 1.0 / (k + 2.0); });
  }

 private:
  static constexpr int terms = model::SpeedCurve::terms;

  template <class Factor>
  T sum(const T& u, const Factor& factor) const {
    T sum = T(0.0);
    for (int k = terms - 1; k >= 0; --k) sum = sum * u + by_[k] * T(factor(k));
    return sum;
  }

  bool present_;
  T rate_, by_[terms];
};

// What one bearing of a tilting rotor takes.
template <class T>
class BearingForce {
 public:
  explicit BearingForce(const model::Bearing& b = {})
      : kappa_mean_(0.5 * (b.stiffness[0] + b.stiffness[1])),
        kappa_half_(0.5 * (b.stiffness[0] - b.stiffness[1])),
        zeta_mean_(0.5 * (b.damping[0] + b.damping[1])),
        zeta_half_(0.5 * (b.damping[0] - b.damping[1])) {}

  void take_lane(const BearingForce& from, int lane) {
    using B = BearingForce;
    take_lane_of(*this, from, lane, &B::kappa_mean_, &B::kappa_half_, &B::zeta_mean_, &B::zeta_half_);
  }

  // `section`: x, y, u, v of the shaft at the bearing; of a rotor whose supports differ in X and Y `rotor` has its
  // angle's sine and cosine. In rotating components.
  HWY_INLINE Vector2<T> of(const RotorMotion<T>& rotor, const T* section) const {
    const T x = section[0], y = section[1], u = section[2], v = section[3];
    const T s2 = T(2.0) * rotor.sin_psi * rotor.cos_psi;
    const T c2 = rotor.cos_psi * rotor.cos_psi - rotor.sin_psi * rotor.sin_psi;
    return {zeta_mean_ * u + kappa_mean_ * x + zeta_half_ * (c2 * u - s2 * v) + kappa_half_ * (c2 * x - s2 * y),
            zeta_mean_ * v + kappa_mean_ * y - zeta_half_ * (s2 * u + c2 * v) - kappa_half_ * (s2 * x + c2 * y)};
  }

 private:
  T kappa_mean_, kappa_half_, zeta_mean_, zeta_half_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
