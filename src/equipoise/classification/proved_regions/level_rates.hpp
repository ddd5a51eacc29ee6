// The equations as proofs run them: on polynomials in what is not a ball's angle (level_proof.cpp, level_boxes.cpp).
#pragma once

#include <array>

#include "equipoise/core/math/affine_form.hpp"
#include "equipoise/core/math/expansion.hpp"
#include "equipoise/core/math/gradient.hpp"
#include "equipoise/core/math/interval.hpp"
#include "equipoise/machine/model/smooth_flow-inl.hpp"
#include "equipoise/classification/proved_regions/level_proof.hpp"

namespace equipoise {

// A number known to lie in an interval.
template <int k>
AffineForm<k> number(const Interval& a, const AffineForm<k>&) {
  return AffineForm<k>(Constant(a));
}
template <int k>
Gradient<Interval, k> number(const Interval& a, const Gradient<Interval, k>&) {
  Gradient<Interval, k> r;
  r.value = a;
  return r;
}

// The torque of a motor below its limit, which check_limit() proves it to be, and the rate of its control's integral.
template <class T, int n, int more>
HWY_NAMESPACE::MotorState<Expansion<T, n, more>> motor_state(const model::DriveSegment& motor,
                                                             const Expansion<T, n, more>&,
                                                             const Expansion<T, n, more>& speed,
                                                             const Expansion<T, n, more>& error) {
  using E = Expansion<T, n, more>;
  E torque = E(motor.constant) + E(motor.slope) * speed;
  if constexpr (more > 1) torque = torque + E(motor.integral) * error;
  return {torque, E(motor.aim) - speed};
}

template <ProofKind kind>
template <class T>
typename LevelProof<kind>::template Rates<T> LevelProof<kind>::rates(const Flow<T>& flow,
                                                                     const std::array<T, n>& angles) const {
  using E = Motion<T>;
  E z[size];
  for (int v = 0; v < etas; ++v) {
    z[row_of(v)] = E::variable(v);
    if constexpr (kind.body) z[row_of(v)] = z[row_of(v)] + E(number(rest_[v], T()));
  }
  for (int i = 0; i < n; ++i) z[model::index::phi(i)] = E(angles[i]);
  Rates<T> result;
  flow(E(0.0), z, result.data());
  return result;
}

}  // namespace equipoise
