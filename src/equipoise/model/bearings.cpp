// Two springs from their sum and its moments.
#include "equipoise/model/bearings.hpp"

#include <cmath>
#include <cstddef>

namespace equipoise::model {

namespace {

// What supports at two places have, from their sum and its first moment; empty if the second moment is not theirs.
std::optional<std::array<double, 2>> shares(double sum, const std::array<double, 2>& moments,
                                            const std::array<double, 2>& places) {
  // Sums and moments are rounded once or twice each, and the shares once more; places are not nearly alike.
  constexpr double rounding = 1e-11;
  const auto [a, b] = places;
  const double of_b = (moments[0] - a * sum) / (b - a), of_a = sum - of_b;
  const double size = std::fabs(of_a) + std::fabs(of_b);
  if (of_a < -rounding * size || of_b < -rounding * size) return std::nullopt;
  const double second = of_a * a * a + of_b * b * b;
  if (!(std::fabs(second - moments[1]) <= rounding * size * (a * a + b * b))) return std::nullopt;
  return std::array<double, 2>{std::fmax(of_a, 0.0), std::fmax(of_b, 0.0)};
}

}  // namespace

std::optional<std::array<Bearing, 2>> two_bearings(const Parameters& p, const std::array<double, 2>& places) {
  if (!p.tilts() || places[0] == places[1]) return std::nullopt;
  std::array<Bearing, 2> both;
  for (std::size_t d = 0; d < 2; ++d) {
    const auto springs = shares(p.stiffness[d], p.tilt.stiffness[d], places),
               dampers = shares(p.damping[d], p.tilt.damping[d], places);
    if (!springs || !dampers) return std::nullopt;
    for (std::size_t b = 0; b < 2; ++b) {
      both[b].stiffness[d] = (*springs)[b];
      both[b].damping[d] = (*dampers)[b];
    }
  }
  return both;
}

}  // namespace equipoise::model
