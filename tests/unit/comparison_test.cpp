// Two samples compared: p values and intervals against independent calculations and against their stated coverage.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "equipoise/core/statistics/comparison.hpp"

namespace equipoise {
namespace comparison_test {

// erfc(z / sqrt 2) with the pooled standard error, computed separately.
TEST(Agreement, LargeCountsUseThePooledNormalTest) {
  // 0.60 of 1000 against 0.65 of 2000: pooled 0.63333, z = 0.05 / 0.0186637 = 2.67900.
  EXPECT_NEAR(agreement_p_value(600, 1000, {0.65, 0.0, 2000}), 0.00738427, 1e-8);  // the digits given
  EXPECT_NEAR(agreement_p_value(650, 1000, {0.65, 0.0, 2000}), 1.0, 1e-12);        // exact equality but for rounding
}

TEST(Agreement, RoundingOfThePrintIsGrantedFirst) {
  EXPECT_DOUBLE_EQ(agreement_p_value(60004, 100000, {0.6000, 0.00005, 100000}), 1.0);
  EXPECT_LT(agreement_p_value(60004, 100000, {0.5900, 0.00005, 100000}), 1e-4);
}

// Two counts 7 and 1 from samples of equal size: given the sum 8 the first is binomial(8, 1/2); outcomes as likely as 7
// or less so: 0, 1, 7, 8, probability (1 + 8 + 8 + 1) / 256.
TEST(Agreement, RareCountsUseTheExactTest) {
  EXPECT_NEAR(agreement_p_value(7, 100000, {1e-5, 0.0, 100000}), 18.0 / 256.0, 1e-12);  // exact rational
  EXPECT_DOUBLE_EQ(agreement_p_value(0, 300000, {0.0, 0.00005, 300000}), 1.0);
  // The same from the other end: all but 7 against all but 1.
  EXPECT_NEAR(agreement_p_value(99993, 100000, {0.99999, 0.0, 100000}), 18.0 / 256.0, 1e-12);
}

// Samples of one probability differ at level p in a share p of cases.
TEST(Agreement, FalseAlarmsComeAtTheirRate) {
  std::mt19937_64 random(5);
  int alarms = 0;
  constexpr int tries = 4000;
  for (int i = 0; i < tries; ++i) {
    std::binomial_distribution<std::uint64_t> ours(4000, 0.6), theirs(300000, 0.6);
    alarms +=
        agreement_p_value(ours(random), 4000, {static_cast<double>(theirs(random)) / 300000.0, 0.0, 300000}) < 0.05;
  }
  // Five standard deviations of a binomial count with probability 0.05.
  EXPECT_NEAR(alarms, 0.05 * tries, 5.0 * std::sqrt(0.05 * 0.95 * tries));
}

// Newcombe (1998), table II, example (a): 56/70 against 48/80, method 10: 0.0524 to 0.3339.
TEST(Difference, IndependentSamplesMatchTheSource) {
  const auto d = independent_difference(wilson_share(48, 80), wilson_share(56, 70));
  EXPECT_NEAR(d.difference, 0.2, 1e-12);
  EXPECT_NEAR(d.low, 0.0524, 5e-5);  // four printed digits
  EXPECT_NEAR(d.high, 0.3339, 5e-5);
}

TEST(Difference, CommonStartsAreCountedInPairs) {
  const auto c = compare_starts({true, true, false, false, true}, {true, false, true, false});
  EXPECT_EQ(c.both, 1u);
  EXPECT_EQ(c.first_only, 1u);
  EXPECT_EQ(c.second_only, 1u);
  EXPECT_EQ(c.neither, 1u);  // the fifth start has no partner
}

// Bonett and Price's formula by hand: n = 100, gained 30, lost 10: p = 31/102, 11/102; centre 20/102;
// se = sqrt((42/102 - (20/102)^2) / 102).
TEST(Difference, PairedIntervalIsTheAdjustedWaldOne) {
  const auto d = paired_difference({40, 10, 30, 20});
  const double se = std::sqrt((42.0 / 102.0 - std::pow(20.0 / 102.0, 2)) / 102.0);
  EXPECT_DOUBLE_EQ(d.difference, 0.2);
  EXPECT_NEAR(d.low, 20.0 / 102.0 - 1.959963984540054 * se, 1e-12);  // rounding
  EXPECT_NEAR(d.high, 20.0 / 102.0 + 1.959963984540054 * se, 1e-12);
}

TEST(Difference, PairedIntervalsHoldTheTruthAsOftenAsPromised) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform;
  int held = 0;
  constexpr int tries = 2000;
  for (int i = 0; i < tries; ++i) {
    CommonStarts c;
    for (int k = 0; k < 400; ++k) {
      const double u = uniform(random);
      ++(u < 0.5 ? c.both : u < 0.55 ? c.first_only : u < 0.7 ? c.second_only : c.neither);
    }
    const auto d = paired_difference(c, 0.95);
    held += d.low < 0.10 && 0.10 < d.high;
  }
  // Five standard deviations; the interval is known to be slightly wide, never narrow.
  EXPECT_NEAR(held, 0.95 * tries, 5.0 * std::sqrt(0.05 * 0.95 * tries));
}

TEST(Difference, NothingComparedKnowsNothing) {
  const auto d = paired_difference({});
  EXPECT_EQ(d.low, -1.0);
  EXPECT_EQ(d.high, 1.0);
}

}  // namespace comparison_test
}  // namespace equipoise
