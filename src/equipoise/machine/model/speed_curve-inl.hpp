// What bends the speed of a prescribed motion over one segment, for every number type. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_SPEED_CURVE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_SPEED_CURVE_INL
#undef EQUIPOISE_MODEL_SPEED_CURVE_INL
#else
#define EQUIPOISE_MODEL_SPEED_CURVE_INL
#endif

#include "equipoise/machine/drives/speed.hpp"
#include "equipoise/machine/model/equation_terms-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

// model::SpeedCurve in numbers of type T.
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

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
