// Tests and intervals for two shares.
#include "equipoise/core/statistics/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "equipoise/core/statistics/distributions.hpp"

namespace equipoise {

namespace {

// Two-sided exact test that two rare counts share one rate: given their sum, the first is binomial.
double rare_p_value(std::uint64_t k1, double n1, std::uint64_t k2, double n2) {
  const std::uint64_t sum = k1 + k2;
  if (sum == 0) return 1.0;
  const Binomial law{static_cast<double>(sum), n1 / (n1 + n2)};
  // Outcomes as likely as the observed one also count; the factor keeps rounding from deciding ties.
  const double seen = law.mass(k1) * (1.0 + 1e-9);
  double p = 0.0;
  for (std::uint64_t k = 0; k <= sum; ++k)
    if (const double q = law.mass(k); q <= seen) p += q;
  return std::min(1.0, p);
}

}  // namespace

double agreement_p_value(std::uint64_t count, std::uint64_t starts, const PublishedShare& published) {
  const double n1 = static_cast<double>(starts), n2 = static_cast<double>(published.starts);
  const double share = static_cast<double>(count) / n1;
  const double target =
      std::clamp(share, std::max(0.0, published.share - published.rounding), published.share + published.rounding);
  const double published_count = target * n2;
  const double pooled = (static_cast<double>(count) + published_count) / (n1 + n2);
  if (std::min(pooled, 1.0 - pooled) * std::min(n1, n2) < 10.0) {
    auto k1 = count, k2 = static_cast<std::uint64_t>(std::llround(std::min(published_count, n2)));
    if (pooled > 0.5) {
      k1 = starts - k1;
      k2 = published.starts - k2;
    }
    return rare_p_value(k1, n1, k2, n2);
  }
  const double deviation = std::sqrt(pooled * (1.0 - pooled) * (1.0 / n1 + 1.0 / n2));
  return std::erfc(std::fabs(share - target) / deviation / std::sqrt(2.0));
}

ShareDifference independent_difference(const Share& first, const Share& second, double confidence) {
  const Share a = wilson_share(first.count, first.total, confidence);
  const Share b = wilson_share(second.count, second.total, confidence);
  ShareDifference result;
  result.difference = b.share - a.share;
  result.low = result.difference - std::hypot(b.share - b.low, a.high - a.share);
  result.high = result.difference + std::hypot(b.high - b.share, a.share - a.low);
  return result;
}

CommonStarts compare_starts(const std::vector<bool>& first, const std::vector<bool>& second) {
  CommonStarts result;
  const std::size_t count = std::min(first.size(), second.size());
  for (std::size_t i = 0; i < count; ++i) {
    if (first[i])
      ++(second[i] ? result.both : result.first_only);
    else
      ++(second[i] ? result.second_only : result.neither);
  }
  return result;
}

ShareDifference paired_difference(const CommonStarts& starts, double confidence) {
  ShareDifference result;
  if (starts.total() == 0) return result;
  const double n = static_cast<double>(starts.total());
  const double gained = static_cast<double>(starts.second_only), lost = static_cast<double>(starts.first_only);
  result.difference = (gained - lost) / n;
  const double p_gained = (gained + 1.0) / (n + 2.0), p_lost = (lost + 1.0) / (n + 2.0);
  const double centre = p_gained - p_lost;
  const double half =
      normal_half_width(confidence) * std::sqrt(std::max(0.0, p_gained + p_lost - centre * centre) / (n + 2.0));
  result.low = std::max(-1.0, centre - half);
  result.high = std::min(1.0, centre + half);
  return result;
}

namespace {

struct Moments {
  std::uint64_t count = 0;
  double mean = 0.0, squares = 0.0;  // sum of squares about the mean

  void add(double value) {
    const double away = value - mean;
    mean += away / static_cast<double>(++count);
    squares += away * (value - mean);
  }
  // Of the mean.
  double variance() const {
    const double n = static_cast<double>(count);
    return squares / (n * (n - 1.0));
  }
};

void put_interval(MeanDifference& d, double variance, double freedom, double confidence) {
  const double half = variance > 0.0 ? students_t_half_width(freedom, confidence) * std::sqrt(variance) : 0.0;
  d.low = d.difference - half;
  d.high = d.difference + half;
}

constexpr double no_bound = std::numeric_limits<double>::infinity();

}  // namespace

MeanDifference paired_mean_difference(const std::vector<double>& first, const std::vector<double>& second,
                                      double confidence) {
  Moments a, b, apart;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(second[i])) continue;
    a.add(first[i]);
    b.add(second[i]);
    apart.add(second[i] - first[i]);
  }
  MeanDifference d{a.count, b.count, a.mean, b.mean, apart.mean, -no_bound, no_bound};
  if (apart.count > 1) put_interval(d, apart.variance(), static_cast<double>(apart.count - 1), confidence);
  return d;
}

MeanDifference independent_mean_difference(const std::vector<double>& first, const std::vector<double>& second,
                                           double confidence) {
  Moments a, b;
  for (const double value : first)
    if (std::isfinite(value)) a.add(value);
  for (const double value : second)
    if (std::isfinite(value)) b.add(value);
  MeanDifference d{a.count, b.count, a.mean, b.mean, b.mean - a.mean, -no_bound, no_bound};
  if (a.count < 2 || b.count < 2) return d;
  const double va = a.variance(), vb = b.variance();
  const double freedom =
      (va + vb) * (va + vb) / (va * va / static_cast<double>(a.count - 1) + vb * vb / static_cast<double>(b.count - 1));
  put_interval(d, va + vb, freedom, confidence);
  return d;
}

}  // namespace equipoise
