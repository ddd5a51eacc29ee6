// The rotor of Wright and Peng (2019).
#pragma once

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// Two equal balls, mu = 0.05 each, lambda = 0.01; zeta and beta as varied in the figures and tables. [speed] and all
/// other settings at their defaults.
inline Study paper_rotor(double zeta = 0.5, double beta = 0.05) {
  Study study;
  model::Parameters& p = study.parameters;
  p.balls = 2;
  p.eccentricity = 0.01;
  p.damping = {zeta, zeta};
  p.mass[0] = p.mass[1] = 0.05;
  p.drag[0] = p.drag[1] = beta;
  return study;
}

}  // namespace equipoise
