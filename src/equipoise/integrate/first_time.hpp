// When in a step something first happens.
#pragma once

#include <optional>

namespace equipoise {

/// The first time in (from, to] at which `happened` answers true; empty if it does at none of the four places that are
/// looked at, nor at those that between(low, high) names, one at most from place to place. To rounding, or to `share`
/// of the way from `from` to `to`. happened(t) is last true where the answer lies.
template <class Happened, class Between>
std::optional<double> first_time(double from, double to, Happened&& happened, Between&& between, double share = 0.0) {
  constexpr int looks = 4;
  const double width = share * (to - from);
  double low = from;
  for (int k = 1; k <= looks; ++k) {
    double high = k == looks ? to : from + (to - from) * k / looks;
    const std::optional<double> inside = between(low, high);
    if (inside && happened(*inside)) {
      high = *inside;
    } else if (!happened(high)) {
      low = high;
      continue;
    }
    double last = high;
    for (;;) {
      const double middle = 0.5 * (low + high);
      if (!(low < middle && middle < high) || high - low < width) break;
      last = middle;
      (happened(middle) ? high : low) = middle;
    }
    if (last != high) happened(high);
    return high;
  }
  return std::nullopt;
}

template <class Happened>
std::optional<double> first_time(double from, double to, Happened&& happened) {
  return first_time(from, to, happened, [](double, double) { return std::optional<double>(); });
}

}  // namespace equipoise
