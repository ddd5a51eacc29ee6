// The equations of motion, once, for every number type: n balls, prescribed rotor speed, rotating frame.
//
// Rows are those of docs/equations.md ("Equations of motion"), which derives them and lists the misprints of
// Wright and Peng (2019) that they correct. State: model/parameters.hpp. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_EQUATIONS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_EQUATIONS_INL
#undef EQUIPOISE_MODEL_EQUATIONS_INL
#else
#define EQUIPOISE_MODEL_EQUATIONS_INL
#endif

#include "equipoise/base/pack-inl.hpp"
#include "equipoise/model/parameters.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Terms beyond the isotropic horizontal rotor at constant speed. A term that is off leaves no operation behind.
struct Terms {
  bool acceleration = true;
  bool anisotropy = true;
  bool gravity = true;
};

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

template <class T, int n, Terms terms>
class BallBalancer {
 public:
  static constexpr int balls = n;
  static constexpr int dimension = model::dimension(n);

  explicit BallBalancer(const model::Parameters& p)
      : lambda_(p.eccentricity),
        zeta_mean_(0.5 * (p.damping[0] + p.damping[1])),
        zeta_half_(0.5 * (p.damping[0] - p.damping[1])),
        kappa_mean_(0.5 * (p.stiffness[0] + p.stiffness[1])),
        kappa_half_(0.5 * (p.stiffness[0] - p.stiffness[1])),
        gravity_(p.gravity),
        mean_inertia_(1.0 + 0.5 * p.total_mass()),
        total_inertia_(1.0 + p.total_mass()) {
    for (int i = 0; i < n; ++i) {
      mu_[i] = T(p.mass[i]);
      beta_[i] = T(p.drag[i]);
    }
  }

  // What springs and dampers exert on the support, in rotating components (fx, fy).
  HWY_INLINE Vector2<T> bearing_force(const RotorMotion<T>& rotor, const T* z) const {
    const T x = z[0], y = z[1], u = z[2], v = z[3];
    Vector2<T> f{zeta_mean_ * u + kappa_mean_ * x, zeta_mean_ * v + kappa_mean_ * y};
    if constexpr (terms.anisotropy) {
      const T s2 = T(2.0) * rotor.sin_psi * rotor.cos_psi;
      const T c2 = rotor.cos_psi * rotor.cos_psi - rotor.sin_psi * rotor.sin_psi;
      f.x = f.x + zeta_half_ * (c2 * u - s2 * v) + kappa_half_ * (c2 * x - s2 * y);
      f.y = f.y - zeta_half_ * (s2 * u + c2 * v) - kappa_half_ * (s2 * x + c2 * y);
    }
    return f;
  }

  // dz/dt with the balls free. `acceleration_of_centre`, if given, receives (Ax, Ay): acceleration of O plus gravity.
  HWY_INLINE void free_derivative(const RotorMotion<T>& rotor, const T* z, T* dz,
                                  Vector2<T>* acceleration_of_centre = nullptr) const {
    const T w = rotor.speed;
    const Vector2<T> f = bearing_force(rotor, z);
    T s[n], c[n];
    T force_x = lambda_ * (w * w) - f.x;
    T force_y = -f.y;
    if constexpr (terms.acceleration) force_y = force_y - lambda_ * rotor.acceleration;
    T double_cos(0.0), double_sin(0.0);  // half the sum of mu_i e^{2 i phi_i}, up to signs below
    for (int i = 0; i < n; ++i) {
      const T q = z[4 + n + i];
      sin_cos(z[4 + i], s[i], c[i]);
      const T total = w + q;
      const T centrifugal = total * total;
      const T drag = beta_[i] * q;
      force_x = force_x + mu_[i] * (centrifugal * c[i] - drag * s[i]);
      force_y = force_y + mu_[i] * (centrifugal * s[i] + drag * c[i]);
      double_cos = double_cos + mu_[i] * (T(0.5) - s[i] * s[i]);
      double_sin = double_sin + mu_[i] * (s[i] * c[i]);
    }
    // [K + C, S; S, K - C] (Ax, Ay) = (Fx, Fy), K = 1 + sum mu_i/2: symmetric positive definite.
    const T determinant = mean_inertia_ * mean_inertia_ - double_cos * double_cos - double_sin * double_sin;
    const T inverse = T(1.0) / determinant;
    const T ax = ((mean_inertia_ - double_cos) * force_x - double_sin * force_y) * inverse;
    const T ay = ((mean_inertia_ + double_cos) * force_y - double_sin * force_x) * inverse;
    for (int i = 0; i < n; ++i) {
      const T q = z[4 + n + i];
      T rate = ax * s[i] - ay * c[i] - beta_[i] * q;
      if constexpr (terms.acceleration) rate = rate - rotor.acceleration;
      dz[4 + i] = q;
      dz[4 + n + i] = rate;
    }
    if (acceleration_of_centre) *acceleration_of_centre = {ax, ay};
    move_centre(rotor, z, {ax, ay}, T(gravity_), dz);
  }

  // d/dt of (x, y, u, v) with the balls held at unbalance U = lambda + sum mu_i e^{i phi_i}, under `gravity`: linear
  // in the state, U and gravity, so solutions superpose.
  HWY_INLINE void clamped_derivative(const RotorMotion<T>& rotor, const Vector2<T>& unbalance, const T& gravity,
                                     const T* z, T* dz, Vector2<T>* acceleration_of_centre = nullptr) const {
    const T w2 = rotor.speed * rotor.speed;
    const T a = rotor.acceleration;
    const Vector2<T> f = bearing_force(rotor, z);
    const T inverse = T(1.0) / total_inertia_;
    const T ax = (unbalance.x * w2 + unbalance.y * a - f.x) * inverse;
    const T ay = (unbalance.y * w2 - unbalance.x * a - f.y) * inverse;
    if (acceleration_of_centre) *acceleration_of_centre = {ax, ay};
    move_centre(rotor, z, {ax, ay}, gravity, dz);
  }

 private:
  HWY_INLINE void move_centre(const RotorMotion<T>& rotor, const T* z, Vector2<T> a, const T& gravity, T* dz) const {
    const T w = rotor.speed;
    if constexpr (terms.gravity) {  // gravity acts only through A = acceleration + (g sin psi, g cos psi)
      a.x = a.x - gravity * rotor.sin_psi;
      a.y = a.y - gravity * rotor.cos_psi;
    }
    dz[0] = z[2] + w * z[1];
    dz[1] = z[3] - w * z[0];
    dz[2] = a.x + w * z[3];
    dz[3] = a.y - w * z[2];
  }

  T lambda_, zeta_mean_, zeta_half_, kappa_mean_, kappa_half_, gravity_, mean_inertia_, total_inertia_;
  T mu_[n], beta_[n];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
