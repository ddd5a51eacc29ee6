// Compares a start's figures with every limit.
#include "equipoise/results/columns/limits_of_start.hpp"

namespace equipoise {

LimitsOfStart limits_of_start(const Limits& limits, const TransientRow& row, double speed, double frequency) {
  LimitsOfStart of;
  of.at_end = !(limits.settled && row.peak_radial_at_end > *limits.settled);
  for (std::size_t k = 0; k < transient_limits.size(); ++k) {
    const TransientLimit& l = transient_limits[k];
    const auto& limit = limits.*l.limit;
    if (!limit) continue;
    const auto beyond = [&](float TransientRow::*figure) {
      return !(row.*figure * (l.by_speed ? l.by_speed->of(speed, frequency) : 1.0) <= *limit);
    };
    of.exceeded[k] = beyond(l.value);
    of.exceeded_at_end[k] = beyond(l.end);
    of.at_end = of.at_end && !of.exceeded_at_end[k];
    of.on_the_way = of.on_the_way && (l.at_end || !of.exceeded[k]);
  }
  return of;
}

}  // namespace equipoise
