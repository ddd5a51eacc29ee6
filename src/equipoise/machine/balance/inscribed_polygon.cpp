// The circle by bisection, from the longest side's half angle at its centre.
#include "equipoise/machine/balance/inscribed_polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "equipoise/core/base/angles.hpp"

namespace equipoise::model {

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
