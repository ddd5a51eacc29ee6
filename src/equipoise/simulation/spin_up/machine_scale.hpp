// The error scale of a machine's trajectory, for states laid out as model::machine_layout().
#pragma once

#include <algorithm>

#include "equipoise/simulation/integrate/adaptive-inl.hpp"
#include "equipoise/machine/model/parameters.hpp"
#include "equipoise/machine/model/state_layout.hpp"

HWY_BEFORE_NAMESPACE();
namespace equipoise {
namespace HWY_NAMESPACE {

template <int dimension>
ErrorScale<dimension> machine_scale(const model::Parameters& p, double tolerance) {
  const model::StateLayout layout = model::machine_layout(p);
  auto scale = error_scale<dimension>(p, tolerance);
  scale.floor[layout.psi] = scale.floor[layout.speed] = scale.floor[layout.error] = 1.0;
  scale.absolute[layout.psi] = scale.angle[layout.psi] = true;
  if (layout.tilt >= 0) std::fill_n(&scale.floor[layout.tilt], 4, scale.floor[model::index::x]);
  return scale;
}

}  // namespace HWY_NAMESPACE
}  // namespace equipoise
HWY_AFTER_NAMESPACE();
