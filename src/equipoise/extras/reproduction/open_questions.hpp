// The questions that Wright and Peng (2019) leave to future work: how eccentricity and ball mass affect where the balls
// end, and what becomes of starts that are not at rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "equipoise/core/running/run_options.hpp"
#include "equipoise/results/commands/basin_result.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// Shares at one speed: of starts all over the box, and of starts at rest with the same ball angles.
struct BoxShares {
  double speed = 0.0;
  BasinResult box, rest;
};

struct OpenQuestions {
  BasinSlice eccentricity_and_angle;  ///< lambda and phi_1, the balls opposite each other
  BasinSlice eccentricity_and_mass;   ///< lambda and mu, the balls at -pi/2 and pi/2
  std::vector<BoxShares> boxes;       ///< by rising speed
  bool complete = true;               ///< false: stopped; the parts that are here are valid
};

/// Progress is in pixels of a slice, then in starts of a sample.
struct OpenQuestionSettings : RunOptions {
  int slice_pixels = 64;         ///< along each side of both slices; a pixel takes 7 to 25 ms on average
  std::uint64_t starts = 20000;  ///< per sample; two samples per speed
  std::uint64_t seed = 1;
  std::string folder;  ///< an existing folder for the samples' per-start results (NetCDF), resumed; empty: none
};

/// The rotor of the paper's section 4 (zeta = 0.5, mu = beta = 0.05, lambda = 0.01) at constant speed 2.4, balls free
/// and everything at rest in the rotating frame, unless a question varies it. The box of the third question: |x|, |y|
/// <= 0.2, |x'|, |y'| <= 0.5, |phi_i'| <= 2.4, any ball angles. The paper names no box, and shares depend on it. This
/// one includes the motions that starts at rest come to (r up to 0.15, x' to 0.25, ball rates to -2.38), rotors held
/// further out, and balls from rest in the fixed frame at speed 2.4 to as fast again ahead of the rotor.
OpenQuestions open_questions(const OpenQuestionSettings& settings = {});

}  // namespace equipoise
