// Mechanical energy, and the powers of dampers and drag, for every number type (docs/explanation/equations.md,
// "Energy"). Included once per CPU target.
#if defined(EQUIPOISE_MODEL_ENERGY_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_ENERGY_INL
#undef EQUIPOISE_MODEL_ENERGY_INL
#else
#define EQUIPOISE_MODEL_ENERGY_INL
#endif

#include <array>
#include <cmath>
#include <cstddef>

#include "equipoise/machine/model/equations-inl.hpp"
#include "equipoise/machine/model/stroboscopic_section.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// For states z of rotor and balls (machine/model/parameters.hpp). sin and cos of psi are read only with anisotropic
// supports or gravity.
template <class T>
class RotorEnergy {
 public:
  explicit RotorEnergy(const model::Parameters& p)
      : balls_(p.balls),
        turning_(model::depends_on_rotor_angle(p)),
        heavy_(p.gravity != 0.0),
        rolls_(p.rolls),
        lambda_(p.eccentricity),
        offset_{T(p.race_offset[0]), T(p.race_offset[1])},
        inertia_(p.inertia),
        stiffness_{T(p.stiffness[0]), T(p.stiffness[1])},
        damping_{T(p.damping[0]), T(p.damping[1])},
        gravity_(p.gravity) {
    for (int i = 0; i < model::max_balls; ++i) {
      mass_[i] = T(p.mass[i]);
      drag_force_[i] = T(p.mass[i] * p.drag[i]);
      radius_[i] = T(p.ball_radius[i]);
    }
  }

  // Copies the rotor of `from` into lane `lane`.
  void take_lane(const RotorEnergy& from, int lane) {
    using E = RotorEnergy;
    take_lane_of(*this, from, lane, &E::lambda_, &E::offset_, &E::inertia_, &E::stiffness_, &E::damping_, &E::gravity_,
                 &E::mass_, &E::drag_force_, &E::radius_);
  }

  // Kinetic energy, and the potential energies of springs and gravity.
  HWY_INLINE T stored(const RotorMotion<T>& rotor, const T* z) const {
    using namespace model::index;
    const T w = rotor.speed, half(0.5);
    const T &lambda = lambda_, &ox = offset_.x, &oy = offset_.y;
    const Vector2<T> place = in_fixed_axes(rotor, z[x], z[y]);
    const T across = z[v] + lambda * w;
    T e = half * (inertia_ * w * w + z[u] * z[u] + across * across + stiffness_.x * place.x * place.x +
                  stiffness_.y * place.y * place.y);
    if (heavy_) e = e + gravity_ * (place.y + lambda * rotor.sin_psi);
    for (int i = 0; i < balls_; ++i) {
      const T own = z[q(i, balls_)], rate = w + own;
      T s, c;
      sin_cos(z[phi(i)], s, c);
      const T vx = z[u] - w * oy - rate * s, vy = z[v] + w * ox + rate * c;
      T one = half * (vx * vx + vy * vy);
      if (heavy_) one = one + gravity_ * (place.y + rotor.sin_psi * (ox + c) + rotor.cos_psi * (oy + s));
      if (rolls_) {
        const T rim = radius_[i] * w - own;  // radius times spin: the ball rolls without slip
        one = one + half * T(model::sphere_inertia.value()) * rim * rim;
      }
      e = e + mass_[i] * one;
    }
    return e;
  }

  // Power dissipated in the supports' dampers.
  HWY_INLINE T taken_by_supports(const RotorMotion<T>& rotor, const T* z) const {
    const Vector2<T> rate = in_fixed_axes(rotor, z[model::index::u], z[model::index::v]);
    return damping_.x * rate.x * rate.x + damping_.y * rate.y * rate.y;
  }

  // Power dissipated by the drag of free balls.
  HWY_INLINE T taken_by_drag(const T* z) const {
    T sum(0.0);
    for (int i = 0; i < balls_; ++i) {
      const T own = z[model::index::q(i, balls_)];
      sum = sum + drag_force_[i] * own * own;
    }
    return sum;
  }

 private:
  // On isotropic supports only squares matter: no rotation is needed.
  HWY_INLINE Vector2<T> in_fixed_axes(const RotorMotion<T>& rotor, const T& x, const T& y) const {
    if (!turning_) return {x, y};
    return {x * rotor.cos_psi - y * rotor.sin_psi, x * rotor.sin_psi + y * rotor.cos_psi};
  }

  int balls_;
  bool turning_, heavy_, rolls_;
  T lambda_;
  Vector2<T> offset_;
  T inertia_;
  Vector2<T> stiffness_, damping_;
  T gravity_;
  T mass_[model::max_balls], drag_force_[model::max_balls], radius_[model::max_balls];
};

// Of a tilting rotor (docs/explanation/equations.md, "A tilting rotor"), whose slopes sx, sy and their rates
// stand from `place` on in the state.
template <class T>
class TiltEnergy {
 public:
  TiltEnergy(const model::Parameters& p, int place)
      : balls_(p.balls),
        place_(place),
        turning_(model::depends_on_rotor_angle(p)),
        lambda_{T(p.eccentricity * std::cos(p.eccentricity_angle)), T(p.eccentricity * std::sin(p.eccentricity_angle))},
        inertia_(p.inertia),
        transverse_(p.tilt.transverse_inertia),
        couple_(p.tilt.couple()),
        gravity_(p.gravity),
        stiffness_{support(p.stiffness, p.tilt.stiffness, 0), support(p.stiffness, p.tilt.stiffness, 1)},
        damping_{support(p.damping, p.tilt.damping, 0), support(p.damping, p.tilt.damping, 1)} {
    for (int i = 0; i < model::max_balls; ++i) {
      mass_[i] = T(p.mass[i]);
      plane_[i] = T(p.tilt.plane[i]);
    }
  }

  // Copies the rotor of `from` into lane `lane`.
  void take_lane(const TiltEnergy& from, int lane) {
    using E = TiltEnergy;
    take_lane_of(*this, from, lane, &E::lambda_, &E::inertia_, &E::transverse_, &E::couple_, &E::gravity_,
                 &E::stiffness_, &E::damping_, &E::mass_, &E::plane_);
  }

  // Velocities along the turning axes, springs in fixed axes.
  HWY_INLINE T stored(const RotorMotion<T>& rotor, const T* z) const {
    using namespace model::index;
    const T w = rotor.speed, half(0.5);
    const T* tilt = z + place_;
    const Vector2<T> centre = in_fixed_axes(rotor, z[x], z[y]), slope = in_fixed_axes(rotor, tilt[0], tilt[1]);
    const T along = z[u] - w * lambda_.y, across = z[v] + w * lambda_.x;
    T e = half * (along * along + across * across + inertia_ * w * w +
                  transverse_ * (tilt[2] * tilt[2] + tilt[3] * tilt[3])) +
          w * couple_ * tilt[3] + gravity_ * (centre.y + lambda_.x * rotor.sin_psi + lambda_.y * rotor.cos_psi) +
          half * (quadratic(stiffness_.x, centre.x, slope.x) + quadratic(stiffness_.y, centre.y, slope.y));
    for (int i = 0; i < balls_; ++i) {
      const T rate = w + z[q(i, balls_)];
      T s, c;
      sin_cos(z[phi(i)], s, c);
      const T vx = z[u] + plane_[i] * tilt[2] - rate * s, vy = z[v] + plane_[i] * tilt[3] + rate * c;
      const T height = centre.y + plane_[i] * slope.y + rotor.sin_psi * c + rotor.cos_psi * s;
      e = e + mass_[i] * (half * (vx * vx + vy * vy) + gravity_ * height);
    }
    return e;
  }

  // Power dissipated in the supports' dampers.
  HWY_INLINE T taken_by_supports(const RotorMotion<T>& rotor, const T* z) const {
    const Vector2<T> centre = in_fixed_axes(rotor, z[model::index::u], z[model::index::v]),
                     slope = in_fixed_axes(rotor, z[place_ + 2], z[place_ + 3]);
    return quadratic(damping_.x, centre.x, slope.x) + quadratic(damping_.y, centre.y, slope.y);
  }

 private:
  struct Support {
    T centre, across, tilt;
  };
  struct Supports {
    Support x, y;
  };
  static Support support(const std::array<double, 2>& of_centre, const std::array<std::array<double, 2>, 2>& of_tilt,
                         std::size_t d) {
    return {T(of_centre[d]), T(of_tilt[d][0]), T(of_tilt[d][1])};
  }
  static HWY_INLINE T quadratic(const Support& m, const T& a, const T& b) {
    return m.centre * a * a + T(2.0) * m.across * a * b + m.tilt * b * b;
  }
  // As in RotorEnergy.
  HWY_INLINE Vector2<T> in_fixed_axes(const RotorMotion<T>& rotor, const T& x, const T& y) const {
    if (!turning_) return {x, y};
    return {x * rotor.cos_psi - y * rotor.sin_psi, x * rotor.sin_psi + y * rotor.cos_psi};
  }

  int balls_, place_;
  bool turning_;
  Vector2<T> lambda_;
  T inertia_, transverse_, couple_, gravity_;
  Supports stiffness_, damping_;
  T mass_[model::max_balls], plane_[model::max_balls];
};

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
