// Chooses speeds first, then distributes the remaining time.
#include "equipoise/machine/drives/spin_up_shape.hpp"

#include <algorithm>
#include <cmath>

namespace equipoise {

namespace {

double needed(const SpinUpShape& shape, double from, double to) {
  const double by_slope = shape.slope ? std::fabs(to - from) / *shape.slope : 0.0;
  return std::max(by_slope, shape.least_duration());
}

double needed(const SpinUpShape& shape, const std::vector<double>& speeds) {
  double sum = 0.0;
  for (std::size_t k = 1; k < speeds.size(); ++k) sum += needed(shape, speeds[k - 1], speeds[k]);
  return sum;
}

// Between the straight way (part 0) and the requested speeds (part 1).
std::vector<double> drawn_in(const SpinUpShape& shape, const std::vector<double>& asked, double part) {
  std::vector<double> speeds = asked;
  const double pieces = static_cast<double>(speeds.size() - 1);
  for (std::size_t k = 1; k + 1 < speeds.size(); ++k) {
    const double straight = shape.initial + (shape.final - shape.initial) * static_cast<double>(k) / pieces;
    speeds[k] = straight + part * (asked[k] - straight);
  }
  return speeds;
}

std::vector<double> speeds_in_time(const SpinUpShape& shape, const std::vector<double>& asked) {
  if (needed(shape, asked) <= shape.until) return asked;
  double fits = 0.0, too_far = 1.0;
  constexpr int halvings = 50;  // to about the last bit
  for (int k = 0; k < halvings; ++k) {
    const double middle = 0.5 * (fits + too_far);
    (needed(shape, drawn_in(shape, asked, middle)) <= shape.until ? fits : too_far) = middle;
  }
  return drawn_in(shape, asked, fits);
}

}  // namespace

double shortest_spin_up(const SpinUpShape& shape) {
  std::vector<double> straight(static_cast<std::size_t>(shape.points) + 2, 0.0);
  straight.front() = shape.initial;
  straight.back() = shape.final;
  return needed(shape, drawn_in(shape, straight, 0.0));
}

SpinUpPoints spin_up_at(const SpinUpShape& shape, std::span<const double> at) {
  const auto points = static_cast<std::size_t>(shape.points);
  std::vector<double> asked{shape.initial};
  for (std::size_t k = 0; k < points; ++k) asked.push_back(shape.low + (shape.high - shape.low) * at[k]);
  asked.push_back(shape.final);
  SpinUpPoints result{{0.0}, speeds_in_time(shape, asked)};
  double left = std::max(0.0, shape.until - needed(shape, result.speeds));
  for (std::size_t k = 0; k <= points; ++k) {
    // The largest of as many uniform draws as parts remain: the stick is then broken uniformly.
    const double slack = left * (1.0 - std::pow(1.0 - at[points + k], 1.0 / static_cast<double>(points + 1 - k)));
    left -= slack;
    result.times.push_back(result.times.back() + needed(shape, result.speeds[k], result.speeds[k + 1]) + slack);
  }
  return result;
}

}  // namespace equipoise
