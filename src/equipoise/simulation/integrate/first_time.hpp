// The first time in a step at which a condition holds.
#pragma once

#include <optional>

namespace equipoise {

/// The first time in (from, to] at which `happened` is true, to rounding or to `share` of to - from. It is tried at
/// four times and at those that between(low, high) names, at most one in each interval; empty if it is true at none of
/// them. happened(t) is last true at the result.
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
