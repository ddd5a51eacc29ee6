// Finds the gap of a fan by bisection, and the circle of a polygon from the longest side's half angle at its centre.
#include "equipoise/machine/balance/cancelling_angles.hpp"

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

std::array<double, max_balls> inscribed_polygon(const Parameters& p) {
  const auto sides = static_cast<std::size_t>(p.balls) + 1;
  std::array<double, max_balls + 1> side{p.eccentricity}, half{};  // half: of the angles at the centre
  std::copy_n(p.mass.begin(), p.balls, side.begin() + 1);
  const std::size_t longest =
      static_cast<std::size_t>(std::max_element(side.begin(), side.begin() + sides) - side.begin());
  // Of the others where the longest has the half angle t, or pi - t.
  const auto others = [&](double t) {
    double sum = 0.0;
    for (std::size_t k = 0; k < sides; ++k)
      if (k != longest) sum += half[k] = std::asin(std::min(1.0, side[k] / side[longest] * std::sin(t)));
    return sum;
  };
  const bool centre_inside = others(0.5 * pi) >= 0.5 * pi;
  double low = 0.0, high = 0.5 * pi;
  for (int k = 0; k < 60; ++k) {  // down to rounding
    const double middle = 0.5 * (low + high);
    (centre_inside == (others(middle) < (centre_inside ? pi - middle : middle)) ? low : high) = middle;
  }
  half[longest] = centre_inside ? low : pi - low;
  others(low);
  std::array<double, max_balls> phi{};
  double turned = 0.0;
  for (std::size_t k = 1; k < sides; ++k) {
    turned += half[k - 1] + half[k];
    phi[k - 1] = turned;
  }
  return phi;
}

}  // namespace equipoise::model
