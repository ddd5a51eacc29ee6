// Lyapunov exponents by following tangent vectors.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "equipoise/attractors/periodic_orbits/orbit.hpp"
#include "equipoise/attractors/periodic_orbits/variational.hpp"
#include "equipoise/core/base/angles.hpp"

namespace equipoise {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// Numbers in [-1, 1) without pattern, the same on every machine (SplitMix64).
double scattered(std::uint64_t& state) {
  std::uint64_t x = state += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-52 - 1.0;
}

// Makes the columns orthonormal by modified Gram-Schmidt, and returns the length left of each.
VectorXd orthonormalise(MatrixXd& columns) {
  VectorXd lengths(columns.cols());
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    for (Eigen::Index j = 0; j < k; ++j) columns.col(k) -= columns.col(j).dot(columns.col(k)) * columns.col(j);
    lengths[k] = columns.col(k).norm();
    columns.col(k) /= lengths[k];
  }
  return lengths;
}

}  // namespace

std::vector<double> lyapunov_exponents(const model::System& system, const VectorXd& state, double duration, int count,
                                       const StopFlag* stop) {
  // Exponents converge like 1 / duration, to 1e-3 to 1e-5. A step error of 1e-6 is far below that, at four tenths of
  // the cost of 1e-9. (The computed trajectory is another one of the same motion, as at any tolerance.)
  constexpr double tolerance = 1e-6;
  // Between reorthonormalisations the slowest vector may fall behind the fastest by this factor, which costs as many
  // digits of their difference.
  constexpr double too_skew = 1e6, hardly_skew = 1e2, shortest_leg = 1e-3, longest_leg = 16.0;
  const double alignment = 0.2 * duration;

  const Eigen::Index columns = std::clamp<Eigen::Index>(count, 0, state.size());
  if (columns == 0) return {};
  MatrixXd vectors(state.size(), columns);
  std::uint64_t seed = 1;
  for (double& entry : vectors.reshaped()) entry = scattered(seed);  // in no invariant subspace of a symmetry
  orthonormalise(vectors);

  VectorXd here = state, sums = VectorXd::Zero(columns);
  double leg = 1.0, t = 0.0;
  while (t < alignment + duration) {
    const bool aligned = t >= alignment;
    const double end = aligned ? alignment + duration : alignment;
    const bool last = t + leg >= end;
    const double psi = std::fmod(system.speed() * t, two_pi);  // matters with a stroboscopic section
    auto flight = follow_tangents(system, here, vectors, last ? end - t : leg, tolerance, psi, stop);
    if (!flight) return {};
    const VectorXd growth = orthonormalise(flight->tangents);
    const double skew = growth.maxCoeff() / growth.minCoeff();
    if (!(skew < too_skew) && leg > shortest_leg) {
      leg *= 0.5;
      continue;
    }
    vectors = flight->tangents;
    here = flight->end;
    for (const auto& [place, turn] : system.angles())  // whole turns come off, so that angles keep their digits
      here[place] = std::remainder(here[place], turn);
    if (aligned) sums += growth.array().log().matrix();
    t = last ? end : t + leg;
    if (skew < hardly_skew) leg = std::min(2.0 * leg, longest_leg);
  }
  std::vector<double> exponents(columns);
  for (Eigen::Index k = 0; k < columns; ++k) exponents[k] = sums[k] / duration;
  std::sort(exponents.begin(), exponents.end(), std::greater<>());
  return exponents;
}

}  // namespace equipoise
