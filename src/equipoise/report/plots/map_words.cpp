// Angles in parts of a turn.
#include "equipoise/report/plots/map_words.hpp"

#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "equipoise/core/base/angles.hpp"

namespace equipoise {

namespace {

// In quarter turns if it is a multiple of one, else as a number.
std::string angle_text(double angle) {
  const double quarters = angle / (0.5 * pi);
  if (std::fabs(quarters - std::round(quarters)) > 1e-9) return fmt::format("{:.4g}", angle);
  const int n = static_cast<int>(std::round(quarters));
  if (n == 0) return "0";
  const std::string times = std::abs(n % 2 ? n : n / 2) == 1 ? "" : fmt::format("{}", std::abs(n % 2 ? n : n / 2));
  return fmt::format("{}{}π{}", n < 0 ? "-" : "", times, n % 2 ? "/2" : "");
}

}  // namespace

std::string fixed_angles_text(const BasinSlice& map) {
  const int balls = map.study.parameters.balls;
  const bool drawn = draws_starts(map);
  std::string text = drawn ? ", ball angles drawn at every point" : "";
  for (int i = 1; i <= balls; ++i) {
    const std::string key = fmt::format("initial.phi_{}", i);
    if (key == map.x.key || key == map.y.key) continue;
    bool tied = false;
    std::string value = angle_text(map.study.initial.phi[static_cast<std::size_t>(i - 1)]);
    for (const AngleLink& link : map.links)
      if (link.ball == i) tied = true, value = fmt::format("φ{} + {}", link.of, angle_text(link.offset));
    if (tied || !drawn) text += fmt::format(", φ{} = {}", i, value);
  }
  return text;
}

}  // namespace equipoise
