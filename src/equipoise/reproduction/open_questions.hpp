// The questions that Wright and Peng (2019) leave to future work: how eccentricity and ball mass change where the balls
// end, and what becomes of starts that are not at rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/results/basin_result.hpp"
#include "equipoise/results/basin_slice.hpp"
#include "equipoise/running/run_options.hpp"

namespace equipoise {

/// Shares at one speed: of starts all over the box, and of starts at rest with the same ball angles.
struct BoxShares {
  double speed = 0.0;
  BasinResult box, rest;
};

struct OpenQuestions {
  BasinSlice eccentricity_and_angle;  ///< lambda and phi_1, the balls opposite one another
  BasinSlice eccentricity_and_mass;   ///< lambda and mu, the balls at -pi/2 and pi/2
  std::vector<BoxShares> boxes;       ///< by rising speed
  bool complete = true;               ///< false: stopped; what is there counts
};

/// Progress is in pixels of a map, then in starts of a sample.
struct OpenQuestionSettings : RunOptions {
  int slice_pixels = 64;         ///< along each side of both maps; a pixel takes 7 to 25 ms on the mean
  std::uint64_t starts = 20000;  ///< a sample, two samples a speed
  std::uint64_t seed = 1;
  std::string folder;  ///< an existing folder for per-start results of the samples (NetCDF), resumed; empty: none
};

/// The rotor of the paper's section 4 (zeta = 0.5, mu = beta = 0.05, lambda = 0.01) at constant speed 2.4, balls free
/// and all at rest in the rotating frame, unless a question varies it. The box of the third question: |x|, |y| <= 0.2,
/// |x'|, |y'| <= 0.5, |phi_i'| <= 2.4, any ball angles. The paper names none, and shares depend on it; this one takes
/// in the motions that starts at rest come to (r up to 0.15, x' to 0.25, ball rates to -2.38), rotors held further out,
/// and balls from rest in the fixed frame at speed 2.4 to as fast again ahead of the rotor.
OpenQuestions open_questions(const OpenQuestionSettings& settings = {});

}  // namespace equipoise
