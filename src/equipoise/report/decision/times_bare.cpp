// Pairs of starts with and without balls.
#include "equipoise/report/decision/times_bare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace equipoise {

namespace {

constexpr std::size_t nine_in_ten = 1;
static_assert(reported_quantiles[nine_in_ten] == 0.9);

// What never vibrates is no louder than what does not either.
double over(double with, double bare) { return with == 0.0 ? 0.0 : with / bare; }

QuantileEstimate over(const QuantileEstimate& with, double bare) {
  return {over(with.value, bare), over(with.low, bare), over(with.high, bare)};
}

TimesBare over_one_run(const TransientGroup& with, const TransientGroup& bare) {
  TimesBare times;
  for (std::size_t q = 0; q < reported_quantiles.size(); ++q)
    times.end_velocity[q] =
        over(with.sure_end_velocity[q], bare.figure(&TransientRow::rms_velocity).quantiles[q].value);
  times.peak = over(with.figure(&TransientRow::peak_radial).quantiles[nine_in_ten],
                    bare.figure(&TransientRow::peak_radial).quantiles[nine_in_ten].value);
  return times;
}

// Undecided starts may come to rest, or to more than any other.
TimesBare pair_by_pair(const std::vector<PairedStart>& with, const std::vector<PairedStart>& bare) {
  Distribution seen, least, most, peaks, bare_peaks;
  for (std::size_t i = 0; i < std::min(with.size(), bare.size()); ++i) {
    const PairedStart &w = with[i], &b = bare[i];
    if (std::isnan(w.peak_radial) || std::isnan(b.peak_radial)) continue;
    const auto velocity = static_cast<float>(over(w.rms_velocity, b.rms_velocity));
    seen.add(velocity, w.weight);
    least.add(w.undecided ? 0.0f : velocity, w.weight);
    most.add(w.undecided ? std::numeric_limits<float>::infinity() : velocity, w.weight);
    peaks.add(w.peak_radial, w.weight);
    bare_peaks.add(b.peak_radial, w.weight);
  }
  TimesBare times{seen.summary().quantiles, {}};
  const auto low = least.summary().quantiles, high = most.summary().quantiles;
  for (std::size_t q = 0; q < reported_quantiles.size(); ++q) {
    times.end_velocity[q].low = low[q].low;
    times.end_velocity[q].high = high[q].high;
  }
  times.peak = over(peaks.summary().quantiles[nine_in_ten], bare_peaks.summary().quantiles[nine_in_ten].value);
  return times;
}

}  // namespace

TimesBare times_bare(const BasinResult& r) {
  const TransientResult& with = *r.transients;
  const OneBodyRuns& bare = r.without_balls->bare;
  return bare.one ? over_one_run(with.groups.front(), bare.figures) : pair_by_pair(with.first, bare.first);
}

}  // namespace equipoise
