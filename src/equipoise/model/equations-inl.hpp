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
        total_inertia_(1.0 + p.total_mass()),
        inertia_sum_(2.0 + p.total_mass()) {
    for (int i = 0; i < n; ++i) {
      mu_[i] = T(p.mass[i]);
      beta_[i] = T(p.drag[i]);
      drag_force_[i] = T(p.mass[i] * p.drag[i]);
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
    T resisting_y = f.y;
    if constexpr (terms.acceleration) resisting_y = resisting_y + lambda_ * rotor.acceleration;
    T force_y(0.0);
    T inertia_y(1.0), coupling(0.0);  // 1 + sum mu_i sin^2 phi_i, sum mu_i sin phi_i cos phi_i
    for (int i = 0; i < n; ++i) {
      const T q = z[4 + n + i];
      sin_cos(z[4 + i], s[i], c[i]);
      const T total = w + q;
      const T centrifugal = mu_[i] * total * total;
      const T drag = drag_force_[i] * q;
      const T mass_sine = mu_[i] * s[i];
      force_x = force_x + centrifugal * c[i] - drag * s[i];
      force_y = centrifugal * s[i] + (i == 0 ? drag * c[i] - resisting_y : drag * c[i] + force_y);
      inertia_y = inertia_y + mass_sine * s[i];
      coupling = coupling + mass_sine * c[i];
    }
    // [inertia_x, coupling; coupling, inertia_y] (Ax, Ay) = (Fx, Fy): symmetric positive definite. The solution is
    // left as (solved_x, solved_y) inverse, so that all that can be done without the quotient need not wait for it.
    const T inertia_x = inertia_sum_ - inertia_y;
    const T inverse = T(1.0) / (inertia_x * inertia_y - coupling * coupling);
    const T solved_x = inertia_y * force_x - coupling * force_y;
    const T solved_y = inertia_x * force_y - coupling * force_x;
    for (int i = 0; i < n; ++i) {
      const T q = z[4 + n + i];
      T resisting = beta_[i] * q;
      if constexpr (terms.acceleration) resisting = resisting + rotor.acceleration;
      dz[4 + i] = q;
      dz[4 + n + i] = (solved_x * s[i] - solved_y * c[i]) * inverse - resisting;
    }
    if (acceleration_of_centre) *acceleration_of_centre = {solved_x * inverse, solved_y * inverse};
    move_centre(rotor, z, {solved_x, solved_y}, inverse, T(gravity_), dz);
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
    move_centre(rotor, z, {ax, ay}, T(1.0), gravity, dz);
  }

 private:
  // d/dt of (x, y, u, v) where O accelerates by a factor, less gravity.
  HWY_INLINE void move_centre(const RotorMotion<T>& rotor, const T* z, const Vector2<T>& a, const T& factor,
                              const T& gravity, T* dz) const {
    const T w = rotor.speed;
    dz[0] = z[2] + w * z[1];
    dz[1] = z[3] - w * z[0];
    dz[2] = a.x * factor + w * z[3];
    dz[3] = a.y * factor - w * z[2];
    if constexpr (terms.gravity) {  // acts only through A = acceleration + (g sin psi, g cos psi)
      dz[2] = dz[2] - gravity * rotor.sin_psi;
      dz[3] = dz[3] - gravity * rotor.cos_psi;
    }
  }

  T lambda_, zeta_mean_, zeta_half_, kappa_mean_, kappa_half_, gravity_, total_inertia_, inertia_sum_;
  T mu_[n], beta_[n], drag_force_[n];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
