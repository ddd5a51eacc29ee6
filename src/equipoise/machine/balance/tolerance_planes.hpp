// The unbalance that ISO 21940-11 judges of a tilting rotor: resolved into two planes across the shaft, each with
// its share of what the whole rotor may have. A plane that holds more than its share fails, whatever the other holds.
#pragma once

#include <array>
#include <complex>
#include <optional>
#include <vector>

#include "equipoise/machine/model/parameters.hpp"

namespace equipoise::model {

/// The outermost two of these bearings, by their places along the shaft; empty if no two differ.
std::optional<std::array<double, 2>> tolerance_planes(const std::vector<double>& bearings);

/// The shares of a rotor's permissible unbalance for planes at two places, which count from its centre of mass: each in
/// proportion to the other's distance from there, and between 0.3 and 0.7. Where the centre of mass is not between the
/// planes the nearer one's may be 1.3.
std::array<double, 2> tolerance_shares(const std::array<double, 2>& planes);

/// The unbalance of one plane over its share, in the rotating frame: own + sum ball_i e^{i phi_i}, to be compared with
/// what the whole rotor may have.
struct PlaneUnbalance {
  std::complex<double> own;
  std::array<double, max_balls> ball{};
};

/// Of a tilting rotor, in two planes. Of planes at one place the static unbalance, twice.
std::array<PlaneUnbalance, 2> plane_unbalances(const Parameters& p, const std::array<double, 2>& planes);

/// Both with the balls at `phi`, one angle a ball.
std::array<std::complex<double>, 2> unbalances_in_planes(const Parameters& p, const std::array<double, 2>& planes,
                                                         const double* phi);
/// The larger of both with the balls at `phi`, one angle a ball. With the centre of mass between the planes it is never
/// less than the static unbalance, and equals it where there is no couple and no share is bounded.
double judged_unbalance(const Parameters& p, const std::array<double, 2>& planes, const double* phi);

}  // namespace equipoise::model
