// Static and couple unbalance as two unbalances, and the lever by which planes share a tolerance.
#include "equipoise/machine/balance/tolerance_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace equipoise::model {

std::optional<std::array<double, 2>> tolerance_planes(const std::vector<double>& bearings) {
  if (bearings.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(bearings.begin(), bearings.end());
  if (*least == *most) return std::nullopt;
  return std::array{*least, *most};
}

std::array<double, 2> tolerance_shares(const std::array<double, 2>& planes) {
  const auto [a, b] = planes;
  const double apart = std::fabs(b - a), most = a * b > 0.0 ? 1.3 : 0.7;
  const auto share = [&](double other) { return std::clamp(std::fabs(other) / apart, 0.3, most); };
  return {share(b), share(a)};
}

std::array<PlaneUnbalance, 2> plane_unbalances(const Parameters& p, const std::array<double, 2>& planes) {
  const std::complex<double> own = std::polar(p.eccentricity, p.eccentricity_angle);
  std::array<PlaneUnbalance, 2> both{PlaneUnbalance{own, p.mass}, PlaneUnbalance{own, p.mass}};
  if (planes[0] == planes[1]) return both;
  const std::array<double, 2> shares = tolerance_shares(planes);
  for (std::size_t k = 0; k < both.size(); ++k) {
    const double other = planes[1 - k], lever = (other - planes[k]) * shares[k];
    both[k].own = (other * own - p.tilt.couple()) / lever;
    for (std::size_t i = 0; i < both[k].ball.size(); ++i) both[k].ball[i] *= (other - p.tilt.plane[i]) / lever;
  }
  return both;
}

std::array<std::complex<double>, 2> unbalances_in_planes(const Parameters& p, const std::array<double, 2>& planes,
                                                         const double* phi) {
  std::array<std::complex<double>, 2> sums;
  const auto both = plane_unbalances(p, planes);
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k] = both[k].own;
    for (int i = 0; i < p.balls; ++i) sums[k] += std::polar(both[k].ball[static_cast<std::size_t>(i)], phi[i]);
  }
  return sums;
}

double judged_unbalance(const Parameters& p, const std::array<double, 2>& planes, const double* phi) {
  const auto [a, b] = unbalances_in_planes(p, planes, phi);
  return std::max(std::abs(a), std::abs(b));
}

}  // namespace equipoise::model
