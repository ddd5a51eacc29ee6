// Alike balls in one place: no real pair stays there, but equal numbers do.
#pragma once

#include <cmath>

#include "equipoise/base/angles.hpp"
#include "equipoise/model/parameters.hpp"

namespace equipoise::model {

/// Nearer than this, in angle and rate, balls count as coincident; so far, and a little more, they are set apart.
inline constexpr double parting = 1e-9;

/// Whether balls i and k are alike and move as one. In exact arithmetic of equal operations they would do so for ever,
/// even where that is unstable.
inline bool coincide(const Parameters& p, int i, int k, const double* phi, const double* rate) {
  return p.alike(i, k) && std::fabs(wrapped(phi[i] - phi[k])) < parting && std::fabs(rate[i] - rate[k]) < parting;
}

/// Sets such balls apart, so that an unstable companionship breaks up. Whether there were any.
inline bool part_coincident(const Parameters& p, double* phi, const double* rate) {
  bool any = false;
  for (int i = 0; i < p.balls; ++i)
    for (int k = 0; k < i; ++k)
      if (coincide(p, i, k, phi, rate)) {
        phi[i] += parting * (i + 1);
        any = true;
      }
  return any;
}

}  // namespace equipoise::model
