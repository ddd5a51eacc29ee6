// From a study's initial values to a state of the equations; from a start's index to its initial values.
#pragma once

#include <algorithm>
#include <cstdint>

#include "equipoise/ensemble/starts.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise {

/// Writes dimension(balls) numbers: the state `s` at rotor speed `speed` (psi' at t = 0).
inline void initial_state(const InitialState& s, int balls, double speed, double* z) {
  z[model::index::x] = s.x;
  z[model::index::y] = s.y;
  z[model::index::u] = s.x_dot - speed * s.y;
  z[model::index::v] = s.y_dot + speed * s.x;
  for (int i = 0; i < balls; ++i) {
    z[model::index::phi(i)] = s.phi[i];
    z[model::index::q(i, balls)] = s.phi_dot[i];
  }
}

/// [initial] of `study` with the ball angles of start `index` of `seed`, and what [sampling.box] asks for.
inline InitialState start_of(const Study& study, std::uint64_t seed, std::uint64_t index) {
  const int balls = study.parameters.balls;
  const SamplingBox& box = study.sampling.box;
  InitialState s = study.initial;
  start_angles(seed, index, balls, s.phi.data());
  if (box.empty()) return s;
  double fractions[4 + model::max_balls];
  start_fractions(seed, index, 4 + balls, fractions);
  const auto draw = [&](const std::optional<SamplingBox::Side>& side, int k, double& value) {
    // A weighted mean: between the bounds also where their difference rounds.
    if (side) value = std::clamp((1.0 - fractions[k]) * side->low + fractions[k] * side->high, side->low, side->high);
  };
  draw(box.x, 0, s.x);
  draw(box.y, 1, s.y);
  draw(box.x_dot, 2, s.x_dot);
  draw(box.y_dot, 3, s.y_dot);
  for (int i = 0; i < balls; ++i) draw(box.phi_dot, 4 + i, s.phi_dot[i]);
  return s;
}

}  // namespace equipoise
