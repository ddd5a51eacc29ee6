// The step errors allowed for machines in ensembles.
#pragma once

#include "equipoise/simulation/integrate/event_trajectory-inl.hpp"
#include "equipoise/machine/model/state_layout.hpp"

namespace equipoise {

/// As on lanes (batch_error_scale()): absolute; the rotor's angle and speed like those of balls.
template <int room>
typename HWY_NAMESPACE::EventTrajectory<room>::Scale ensemble_scale(const model::Parameters& p, double tolerance) {
  typename HWY_NAMESPACE::EventTrajectory<room>::Scale scale;
  scale.tolerance = tolerance;
  scale.floor.fill(1.0);
  for (int i = 0; i < 4; ++i) scale.floor[i] = p.all_unbalances();
  scale.absolute.fill(true);
  for (int i = 0; i < p.balls; ++i) scale.angle[model::index::phi(i)] = true;
  scale.angle[model::machine_layout(p.balls).psi] = true;
  return scale;
}

}  // namespace equipoise
