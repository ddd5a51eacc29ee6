// What one bearing of a rotor that tilts takes. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_BEARING_FORCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_BEARING_FORCE_INL
#undef EQUIPOISE_MODEL_BEARING_FORCE_INL
#else
#define EQUIPOISE_MODEL_BEARING_FORCE_INL
#endif

#include "equipoise/core/base/pack-inl.hpp"
#include "equipoise/machine/model/bearings.hpp"
#include "equipoise/machine/model/equation_terms-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

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
