// Answers to the questions that Wright and Peng (2019) leave to future work.
#pragma once

#include <vector>

#include "equipoise/results/basin_result.hpp"
#include "equipoise/results/plane_map.hpp"

namespace equipoise {

/// Shares at one speed: of starts all over the box, and of starts at rest with the same ball angles.
struct BoxShares {
  double speed = 0.0;
  BasinResult box, rest;
};

struct OpenQuestions {
  PlaneMap eccentricity_and_angle;  ///< lambda and phi_1, the balls opposite one another
  PlaneMap eccentricity_and_mass;   ///< lambda and mu, the balls at -pi/2 and pi/2
  std::vector<BoxShares> boxes;     ///< by rising speed
  bool complete = true;             ///< false: stopped; what is there counts
};

}  // namespace equipoise
