// Quantiles and their intervals: ranks, coverage, bins, weights.
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/statistics/quantile.hpp"

namespace equipoise {
namespace quantile_test {

TEST(QuantileRanks, AreThoseOfTables) {
  // n = 100, median, 95 %: ranks 40 and 61 (Conover, Practical Nonparametric Statistics, 3rd ed., table A3 gives 40).
  const RankInterval median = quantile_ranks(100, 0.5);
  EXPECT_EQ(median.low, 40u);
  EXPECT_EQ(median.high, 61u);
  // No upper bound for the 99 % quantile while 0.99^n > 0.025, that is up to n = 367.
  EXPECT_EQ(quantile_ranks(367, 0.99).high, 368u);
  EXPECT_EQ(quantile_ranks(368, 0.99).high, 368u);
  // Nor bounds for a handful: P(K < 1) = 1/32 > 0.025 for five values and their median.
  EXPECT_EQ(quantile_ranks(5, 0.5).low, 0u);
  EXPECT_EQ(quantile_ranks(5, 0.5).high, 6u);
  EXPECT_EQ(quantile_ranks(6, 0.5).low, 1u);
  EXPECT_EQ(quantile_ranks(6, 0.5).high, 6u);
  EXPECT_EQ(quantile_ranks(0, 0.5).low, 0u);
}

// P(l <= K < u) for a binomial K: what an interval of these ranks covers.
double coverage(int n, double p, const RankInterval& ranks) {
  double sum = 0.0;
  for (int k = static_cast<int>(ranks.low); k < static_cast<int>(ranks.high); ++k)
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(p) +
                    (n - k) * std::log1p(-p));
  return sum;
}

// For the exponential law, whose quantiles are known. Ranks are integers, so coverage is 95 % or a little more; 4000
// trials measure it to four standard errors, 4 sqrt(0.05 / 4000) = 1.4 %.
TEST(Distribution, IntervalsCoverAsOftenAsTheySay) {
  std::mt19937_64 random(5);
  std::exponential_distribution<float> law(1.0f);
  constexpr int trials = 4000;
  for (const int size : {100, 500}) {
    std::array<int, reported_quantiles.size()> covered{};
    int mean_covered = 0;
    for (int trial = 0; trial < trials; ++trial) {
      Distribution d;
      for (int i = 0; i < size; ++i) d.add(law(random));
      const SampleSummary s = d.summary();
      for (std::size_t k = 0; k < covered.size(); ++k) {
        const double truth = -std::log(1.0 - reported_quantiles[k]);
        covered[k] += s.quantiles[k].low <= truth && truth <= s.quantiles[k].high;
      }
      mean_covered += s.mean_low <= 1.0 && 1.0 <= s.mean_high;
    }
    for (std::size_t k = 0; k < covered.size(); ++k) {
      const double p = reported_quantiles[k], expected = coverage(size, p, quantile_ranks(size, p));
      EXPECT_GE(expected, 0.95);
      EXPECT_NEAR(covered[k], expected * trials, 0.014 * trials) << size << ", quantile " << p;
    }
    // Student's t for a skewed law: a little less than 95 % (a skewness of 2 costs about 0.3 % at n = 200).
    EXPECT_NEAR(mean_covered, 0.95 * trials, 0.015 * trials);
  }
}

TEST(Distribution, TellsQuantilesOfTheSample) {
  Distribution d;
  for (int i = 100; i >= 1; --i) d.add(static_cast<float>(i));
  const SampleSummary s = d.summary();
  EXPECT_EQ(s.count, 100u);
  EXPECT_DOUBLE_EQ(s.mean, 50.5);
  EXPECT_DOUBLE_EQ(s.largest, 100.0);
  EXPECT_DOUBLE_EQ(s.quantiles[0].value, 50.0);
  EXPECT_DOUBLE_EQ(s.quantiles[0].low, 40.0);
  EXPECT_DOUBLE_EQ(s.quantiles[0].high, 61.0);
  EXPECT_DOUBLE_EQ(s.quantiles[1].value, 90.0);
  EXPECT_DOUBLE_EQ(s.quantiles[2].value, 99.0);
  EXPECT_TRUE(std::isinf(s.quantiles[2].high));
  // s^2 = (100^2 - 1)/12 * 100/99; t(99) at 97.5 % = 1.98422.
  EXPECT_NEAR(s.mean_high - s.mean, 1.98422 * std::sqrt((1e4 - 1.0) / 12.0 / 99.0), 1e-4);
}

TEST(Distribution, CountsWhatHasNoEnd) {
  Distribution d;
  for (int i = 1; i <= 10; ++i) d.add(i <= 4 ? static_cast<float>(i) : std::numeric_limits<float>::infinity());
  const SampleSummary s = d.summary();
  EXPECT_EQ(s.open, 6u);
  EXPECT_DOUBLE_EQ(s.mean, 2.5);
  EXPECT_TRUE(std::isinf(s.quantiles[0].value));
  EXPECT_TRUE(std::isinf(s.largest));
  EXPECT_EQ(s.quantiles[0].low, 2.0);  // rank 2 of 10
}

// Quantiles from bins are centres of bins 0.54 % wide.
TEST(Distribution, BinsAgreeWithOrderStatistics) {
  std::mt19937_64 random(11);
  std::lognormal_distribution<float> law(-4.0f, 1.5f);
  Distribution exact, binned(1000), first(1000), second(1000), small;
  for (int i = 0; i < 30000; ++i) {
    const float value = i % 50 == 0 ? 0.0f : law(random);
    exact.add(value);
    binned.add(value);
    (i % 3 == 0 ? first : second).add(value);
  }
  Distribution merged(1000);
  merged.merge(first);
  merged.merge(second);
  const SampleSummary a = exact.summary(), b = binned.summary(), c = merged.summary();
  EXPECT_TRUE(a.exact);
  EXPECT_FALSE(b.exact);
  for (std::size_t k = 0; k < a.quantiles.size(); ++k) {
    EXPECT_NEAR(b.quantiles[k].value, a.quantiles[k].value, 0.0028 * a.quantiles[k].value);
    EXPECT_NEAR(b.quantiles[k].low, a.quantiles[k].low, 0.0028 * a.quantiles[k].low);
    EXPECT_NEAR(b.quantiles[k].high, a.quantiles[k].high, 0.0028 * a.quantiles[k].high);
    EXPECT_EQ(c.quantiles[k].value, b.quantiles[k].value);
    EXPECT_EQ(c.quantiles[k].high, b.quantiles[k].high);
  }
  EXPECT_EQ(a.mean, b.mean);
  EXPECT_NEAR(c.mean, a.mean, 1e-12);  // sums of 30 000 terms in two orders
  EXPECT_NEAR(c.mean_high, a.mean_high, 1e-12);
}

// A start of weight 2 counts as two starts for a quantile; intervals are those of fewer starts, Kish's number.
TEST(Distribution, CountsWeights) {
  Distribution weighted, repeated;
  for (int i = 1; i <= 200; ++i) {
    const float value = static_cast<float>(i * i % 211);
    const int weight = i % 3 == 0 ? 2 : 1;
    weighted.add(value, weight);
    for (int k = 0; k < weight; ++k) repeated.add(value);
  }
  const SampleSummary w = weighted.summary(), r = repeated.summary();
  EXPECT_NEAR(w.mean, r.mean, 1e-10);
  for (std::size_t k = 0; k < w.quantiles.size(); ++k) EXPECT_EQ(w.quantiles[k].value, r.quantiles[k].value);
  EXPECT_LE(w.quantiles[0].low, r.quantiles[0].low);
  EXPECT_GE(w.quantiles[0].high, r.quantiles[0].high);
}

}  // namespace quantile_test
}  // namespace equipoise
