// Finds the gap of a fan by bisection.
#include "equipoise/machine/balance/fan.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::model {

std::array<double, max_balls> fan(const Parameters& p, const std::vector<double>& width) {
  std::vector<std::size_t> order(width.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return p.mass[a] > p.mass[b]; });
  std::vector<std::size_t> row;
  for (std::size_t k = 0; k < order.size(); ++k) row.insert(k % 2 ? row.end() : row.begin(), order[k]);
  const double filled = std::accumulate(width.begin(), width.end(), 0.0);
  std::array<double, max_balls> phi{};
  const auto spread = [&](double gap) {
    std::complex<double> sum;
    double at = 0.0;
    for (const std::size_t i : row) {
      phi[i] = at + 0.5 * width[i];
      at += width[i] + gap;
      sum += std::polar(p.mass[i], phi[i]);
    }
    for (const std::size_t i : row) phi[i] += pi - std::arg(sum);
    return std::abs(sum);
  };
  double narrow = 0.0, wide = (two_pi - filled) / static_cast<double>(row.size());
  for (int k = 0; k < 60; ++k) {  // down to rounding
    const double middle = 0.5 * (narrow + wide);
    (spread(middle) > p.eccentricity ? narrow : wide) = middle;
  }
  spread(narrow);
  return phi;
}

}  // namespace equipoise::model
