// Springs from their sum and its moments, and back.
#include "equipoise/machine/model/bearings.hpp"

#include <cmath>
#include <optional>

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

bool make(const std::vector<Bearing>& bearings, std::array<double, 2> Bearing::*part, std::size_t direction,
          const SupportMatrix& wanted) {
  constexpr double as_typed = 1e-6;
  SupportMatrix sum, size;
  for (const Bearing& b : bearings) {
    sum.add((b.*part)[direction], b.at);
    size.add(std::fabs((b.*part)[direction]), std::fabs(b.at));
  }
  for (const auto k : {&SupportMatrix::centre, &SupportMatrix::across, &SupportMatrix::tilt})
    if (!(std::fabs(sum.*k - wanted.*k) <= as_typed * size.*k)) return false;
  return true;
}

}  // namespace

std::vector<Bearing> two_bearings(const Parameters& p, const std::array<double, 2>& places) {
  if (!p.tilts() || places[0] == places[1]) return {};
  std::vector<Bearing> both{{places[0], {}, {}}, {places[1], {}, {}}};
  for (std::size_t d = 0; d < 2; ++d) {
    const auto springs = shares(p.stiffness[d], p.tilt.stiffness[d], places),
               dampers = shares(p.damping[d], p.tilt.damping[d], places);
    if (!springs || !dampers) return {};
    for (std::size_t b = 0; b < 2; ++b) {
      both[b].stiffness[d] = (*springs)[b];
      both[b].damping[d] = (*dampers)[b];
    }
  }
  return both;
}

bool make_stiffness(const std::vector<Bearing>& bearings, const Parameters& p) {
  for (std::size_t d = 0; d < 2; ++d)
    if (!make(bearings, &Bearing::stiffness, d, {p.stiffness[d], p.tilt.stiffness[d][0], p.tilt.stiffness[d][1]}))
      return false;
  return true;
}

bool make_damping(const std::vector<Bearing>& bearings, const Parameters& p) {
  for (std::size_t d = 0; d < 2; ++d)
    if (!make(bearings, &Bearing::damping, d, {p.damping[d], p.tilt.damping[d][0], p.tilt.damping[d][1]})) return false;
  return true;
}

}  // namespace equipoise::model
