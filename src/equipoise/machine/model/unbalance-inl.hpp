// The unbalance of rotor and balls, for every number type. Included once per CPU target.
#if defined(EQUIPOISE_MODEL_UNBALANCE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef EQUIPOISE_MODEL_UNBALANCE_INL
#undef EQUIPOISE_MODEL_UNBALANCE_INL
#else
#define EQUIPOISE_MODEL_UNBALANCE_INL
#endif

#include "equipoise/machine/model/equations-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

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

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();

#endif
