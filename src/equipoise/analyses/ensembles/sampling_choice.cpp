// How many starts are needed, from a pilot's intervals.
#include "equipoise/analyses/ensembles/sampling_choice.hpp"

#include <algorithm>
#include <cmath>

namespace equipoise {

namespace {
// 97.5 % quantile of the normal distribution.
constexpr double z = 1.959963984540054;

// Wilson's half-width is z sqrt(p q n + z^2/4) / (n + z^2); solved for n with b = z^2 / h^2.
double wilson_starts(double p, double h) {
  const double pq = p * (1.0 - p), b = z * z / (h * h), linear = 0.5 * b * pq - z * z;
  return std::max(linear + std::sqrt(std::max(linear * linear + z * z * (0.25 * b - z * z), 0.0)), 0.0);
}
}  // namespace

double most_random_starts(double half_width) { return wilson_starts(0.5, half_width); }

double random_starts_for(const std::vector<Share>& shares, double half_width) {
  double most = 0.0;
  for (const Share& s : shares) most = std::max(most, wilson_starts(s.share, half_width));
  return most;
}

SamplingChoice choose_sampling(const std::vector<Share>& pilot, double half_width) {
  SamplingChoice choice;
  choice.random_starts = random_starts_for(pilot, half_width);
  for (const Share& s : pilot) {
    const double ratio = s.half_width() / half_width;
    const double needed =
        s.by == IntervalBy::wilson ? wilson_starts(s.share, half_width) : static_cast<double>(s.total) * ratio * ratio;
    choice.sobol_starts = std::max(choice.sobol_starts, needed);
  }
  choice.pilot = pilot.front().total;
  choice.method = choice.sobol_starts - static_cast<double>(choice.pilot) < choice.random_starts
                      ? SamplingMethod::sobol
                      : SamplingMethod::random;
  return choice;
}

}  // namespace equipoise
