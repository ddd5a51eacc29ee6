// Mechanical energy, and what dampers and drag take of it, for every number type (docs/equations.md, "Energy").
// Included once per CPU target.
#if defined(EQUIPOISE_MODEL_ENERGY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_ENERGY_INL
#undef EQUIPOISE_MODEL_ENERGY_INL
#else
#define EQUIPOISE_MODEL_ENERGY_INL
#endif

#include "equipoise/model/equations-inl.hpp"
#include "equipoise/model/strobe.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// Of rotor and balls in states z as in model/parameters.hpp; sin and cos of psi are read only where supports are
// anisotropic or gravity acts.
template <class T>
class RotorEnergy {
 public:
  explicit RotorEnergy(const model::Parameters& p) : p_(p), turning_(model::is_strobed(p)) {}

  // Kinetic, of the supports' springs, and of gravity.
  HWY_INLINE T stored(const RotorMotion<T>& rotor, const T* z) const {
    using namespace model::index;
    const T w = rotor.speed, lambda(p_.eccentricity), half(0.5);
    const T ox(p_.race_offset[0]), oy(p_.race_offset[1]);
    const Vector2<T> place = in_fixed_axes(rotor, z[x], z[y]);
    const T across = z[v] + lambda * w;
    T e = half * (T(p_.inertia) * w * w + z[u] * z[u] + across * across + T(p_.stiffness[0]) * place.x * place.x +
                  T(p_.stiffness[1]) * place.y * place.y);
    if (p_.gravity != 0.0) e = e + T(p_.gravity) * (place.y + lambda * rotor.sin_psi);
    for (int i = 0; i < p_.balls; ++i) {
      const T own = z[q(i, p_.balls)], rate = w + own, mass(p_.mass[i]);
      T s, c;
      sin_cos(z[phi(i)], s, c);
      const T vx = z[u] - w * oy - rate * s, vy = z[v] + w * ox + rate * c;
      T one = half * (vx * vx + vy * vy);
      if (p_.gravity != 0.0)
        one = one + T(p_.gravity) * (place.y + rotor.sin_psi * (ox + c) + rotor.cos_psi * (oy + s));
      if (p_.rolls) {
        const T rim = T(p_.ball_radius[i]) * w - own;  // radius times spin, from where it touches
        one = one + half * T(model::sphere_inertia.value()) * rim * rim;
      }
      e = e + mass * one;
    }
    return e;
  }

  // What the supports' dampers take in a unit of time.
  HWY_INLINE T taken_by_supports(const RotorMotion<T>& rotor, const T* z) const {
    const Vector2<T> rate = in_fixed_axes(rotor, z[model::index::u], z[model::index::v]);
    return T(p_.damping[0]) * rate.x * rate.x + T(p_.damping[1]) * rate.y * rate.y;
  }

  // And the drag of balls that run free.
  HWY_INLINE T taken_by_drag(const T* z) const {
    T sum(0.0);
    for (int i = 0; i < p_.balls; ++i) {
      const T own = z[model::index::q(i, p_.balls)];
      sum = sum + T(p_.mass[i] * p_.drag[i]) * own * own;
    }
    return sum;
  }

 private:
  // Their squares alone matter where no direction is preferred.
  HWY_INLINE Vector2<T> in_fixed_axes(const RotorMotion<T>& rotor, const T& x, const T& y) const {
    if (!turning_) return {x, y};
    return {x * rotor.cos_psi - y * rotor.sin_psi, x * rotor.sin_psi + y * rotor.cos_psi};
  }

  const model::Parameters p_;
  const bool turning_;
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
