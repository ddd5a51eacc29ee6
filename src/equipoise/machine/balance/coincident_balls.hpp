// Alike balls in the same state: a real pair would separate, but equal numbers stay equal.
#pragma once

#include <cmath>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// Balls closer than this in angle and rate coincide. They are set apart by small multiples of it.
inline constexpr double parting = 1e-9;

/// Whether balls i and k are alike and move as one. Equal operations on equal numbers would keep them together for
/// ever, even where that is unstable.
inline bool coincide(const Parameters& p, int i, int k, const double* phi, const double* rate) {
  return p.alike(i, k) && std::fabs(wrapped(phi[i] - phi[k])) < parting && std::fabs(rate[i] - rate[k]) < parting;
}

/// Sets coincident balls apart, so that an unstable pair separates. Returns whether there were any.
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
