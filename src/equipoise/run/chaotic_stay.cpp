// The hazard of leaving chaos over the second half of the pilot, and exponents of those that did not.
#include "equipoise/run/chaotic_stay.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "equipoise/attractors/orbit.hpp"
#include "equipoise/attractors/stroboscopic.hpp"
#include "equipoise/model/strobe.hpp"

namespace equipoise {

namespace {

// Undecided starts that matter, followed for so long: exponents of regular motion are then below 8 / duration.
constexpr double least_share = 0.01, duration = 1000.0, regular = 8.0 / duration;
constexpr std::size_t followed = 5;

double largest_exponent(const model::Parameters& p, double speed, const Eigen::VectorXd& state) {
  const std::vector<double> exponents =
      model::is_strobed(p) ? strobed_exponents(p, speed, state, std::lround(duration / model::strobe_period(p, speed)))
                           : lyapunov_exponents(p, speed, state, duration, 1);
  return exponents.empty() ? 0.0 : exponents.front();
}

}  // namespace

std::string chaotic_stay(const model::Parameters& p, double speed, const PilotOutcome& pilot) {
  const std::vector<Fate>& fates = *pilot.fates;
  const double middle = 0.5 * (pilot.begin + pilot.end);
  std::vector<std::size_t> undecided;
  double exposure = 0.0;
  int left = 0;
  for (std::size_t i = 0; i < fates.size(); ++i) {
    const bool open = fates[i].outcome == Outcome::undecided;
    if (open && fates[i].attractor == 0) undecided.push_back(i);
    if (fates[i].time <= middle && !open) continue;
    exposure += (open ? pilot.end : fates[i].time) - middle;
    left += open ? 0 : 1;
  }
  const double share = static_cast<double>(undecided.size()) / static_cast<double>(fates.size());
  if (undecided.empty() || share < least_share) return "";
  const std::size_t taken = std::min(followed, undecided.size());
  std::vector<double> exponents;
  for (std::size_t k = 0; k < taken; ++k) {
    const double exponent = largest_exponent(p, speed, pilot.state(undecided[k * undecided.size() / taken]));
    if (exponent > regular) exponents.push_back(exponent);
  }
  if (2 * exponents.size() < taken) return "";
  std::sort(exponents.begin(), exponents.end());
  // Nothing seen to end in that time, or next to nothing: the stay is longer than a third of it (95 %, Poisson).
  constexpr int few = 3;
  const std::string stay = left > few ? fmt::format("{:.2g} time units on average", exposure / left)
                                      : fmt::format("more than {:.2g} time units on average", exposure / (3.0 + left));
  return fmt::format(
      "{:.0f} % of starts go on chaotically (largest Lyapunov exponent {:.3f}) before they come to anything, for {}; "
      "they are undecided as long as they do",
      100.0 * share, exponents[exponents.size() / 2], stay);
}

}  // namespace equipoise
