// Intervals of evenly sampled shares: coverage for sets of known area, rare sets, aligned sets.
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/ensembles/sampling_choice.hpp"
#include "equipoise/analyses/ensembles/tally.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/statistics/even_share.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {
namespace even_share_test {

using Set = std::function<bool(double, double)>;  // of angles in turns

Set disc(double area) {
  const double radius = std::sqrt(area / pi);
  return [=](double x, double y) { return std::hypot(x - 0.47, y - 0.53) < radius; };
}
// Two separate discs, mirror images under exchange of the balls.
Set mirrored_discs(double area) {
  const double radius = std::sqrt(0.5 * area / pi);
  return [=](double x, double y) {
    return std::hypot(x - 0.27, y - 0.71) < radius || std::hypot(x - 0.71, y - 0.27) < radius;
  };
}

Tally tally_of(const Sampler& sampler, std::uint64_t seed, std::uint64_t starts, const Set& inside) {
  Tally tally(sampler, seed, 0.0);
  for (std::uint64_t i = 0; i < starts; ++i) {
    double phi[2];
    sampler.angles(seed, i, phi);
    Outcome outcome;
    outcome.kind = OutcomeKind::attracted;
    outcome.attractor = inside(phi[0] / two_pi, phi[1] / two_pi) ? 1 : 2;
    tally.add(outcome);
  }
  return tally;
}

struct Coverage {
  double covered = 0.0, error = 0.0, claimed = 0.0, half_width = 0.0;
  int by_spread = 0;
};

Coverage coverage(SamplingMethod method, bool exchange, std::uint64_t starts, const Set& inside, double truth,
                  int trials) {
  const Sampler sampler(method, 2, starts, exchange);
  const std::uint64_t count = sampler.grid() ? sampler.grid()->starts() : starts;
  Coverage result;
  for (int trial = 0; trial < trials; ++trial) {
    const Share s =
        tally_of(sampler, 1000 + static_cast<std::uint64_t>(trial), count, inside).share(OutcomeKind::attracted, 1);
    result.covered += (s.low <= truth && truth <= s.high) / double(trials);
    result.error += (s.share - truth) * (s.share - truth) / trials;
    result.claimed += s.standard_error * s.standard_error / trials;
    result.half_width += s.half_width() / trials;
    result.by_spread += s.by != IntervalBy::wilson;
  }
  return result;
}

// With 300 trials 95 % are known to 1.26 points; five such errors are allowed. A variance from so many is known to 8.2
// %, and the mean of so many claimed ones, of 15 degrees of freedom each, to 2.1 %: five errors of the ratio are 42 %.
constexpr int trials = 300;

class SobolIntervals : public testing::TestWithParam<double> {};
TEST_P(SobolIntervals, CoverADiscAsOftenAsTheySay) {
  const double area = GetParam();
  const Coverage c = coverage(SamplingMethod::sobol, false, 4096, disc(area), area, trials);
  EXPECT_EQ(c.by_spread, trials);
  EXPECT_NEAR(c.covered, 0.95, 0.063);
  EXPECT_NEAR(c.claimed / c.error, 1.0, 0.42);
  EXPECT_LT(c.error, 0.6 * area * (1.0 - area) / 4096);  // better than random: measured 0.25 to 0.35
}
INSTANTIATE_TEST_SUITE_P(Area, SobolIntervals, testing::Values(0.5, 0.1));

// Sobol points of a partial last round: replicates differ by a start.
TEST(EvenShares, SobolIntervalsCoverForAnyNumberOfStarts) {
  const Coverage c = coverage(SamplingMethod::sobol, false, 3001, disc(0.3), 0.3, trials);
  EXPECT_NEAR(c.covered, 0.95, 0.063);
  EXPECT_NEAR(c.claimed / c.error, 1.0, 0.42);
}

// Wilson's interval is for binomial counts, whose variance rare sets nearly have. Coverage is 95 % or more, less the
// effect of a discrete count (1.5 points) and five errors of 1.8 points for 150 trials.
class RareShares : public testing::TestWithParam<double> {};  // 0.8, 8 and 41 of 4096 starts
constexpr int rare = 150;
TEST_P(RareShares, AreCoveredBySobolIntervals) {
  EXPECT_GT(coverage(SamplingMethod::sobol, false, 4096, disc(GetParam()), GetParam(), rare).covered, 0.84);
}
TEST_P(RareShares, AreCoveredByGridIntervals) {
  EXPECT_GT(coverage(SamplingMethod::grid, false, 4096, disc(GetParam()), GetParam(), rare).covered, 0.84);
}
TEST_P(RareShares, AreCoveredByFoldedGridIntervals) {
  EXPECT_GT(coverage(SamplingMethod::grid, true, 4096, mirrored_discs(GetParam()), GetParam(), rare).covered, 0.84);
}
INSTANTIATE_TEST_SUITE_P(Area, RareShares, testing::Values(0.0002, 0.002, 0.01));

// Where the two intervals meet, near 80 starts, either may be used.
TEST(EvenShares, EitherIntervalIsTakenWhereTheyMeet) {
  const Coverage meeting = coverage(SamplingMethod::sobol, false, 4096, disc(0.0195), 0.0195, trials);
  EXPECT_GT(meeting.by_spread, trials / 10);
  EXPECT_LT(meeting.by_spread, trials - trials / 10);
  EXPECT_NEAR(meeting.covered, 0.95, 0.063);
}

void expect_covered_by_a_grid(bool folded, const Set& inside, double area) {
  const Coverage c = coverage(SamplingMethod::grid, folded, 8192, inside, area, trials);
  EXPECT_EQ(c.by_spread, trials);
  EXPECT_NEAR(c.covered, 0.95, 0.063);
  EXPECT_NEAR(c.claimed / c.error, 1.0, 0.42);
  EXPECT_LT(c.error, 0.25 * 0.21 / 8192);  // measured a tenth of the binomial variance
}
TEST(EvenShares, GridIntervalsCoverADiscAsOftenAsTheySay) { expect_covered_by_a_grid(false, disc(0.3), 0.3); }
TEST(EvenShares, FoldedGridIntervalsCoverDiscsAsOftenAsTheySay) {
  expect_covered_by_a_grid(true, mirrored_discs(0.2), 0.2);
}

// Every replicate meets the share of a half turn exactly: the rule for agreeing replicates keeps the interval open.
TEST(EvenShares, IntervalsNeverCollapse) {
  const Set half = [](double x, double) { return x < 0.5; };
  const Sampler sobol(SamplingMethod::sobol, 2, 4096, false), grid(SamplingMethod::grid, 2, 2 * 40 * 40, false);
  const Share even = tally_of(sobol, 1, 4096, half).share(OutcomeKind::attracted, 1);
  EXPECT_EQ(even.share, 0.5);
  EXPECT_EQ(even.by, IntervalBy::replicates);
  EXPECT_NEAR(even.half_width(), (1.0 - std::pow(0.05, 1.0 / 16)) / 256, 1e-15);
  const Share cells = tally_of(grid, 1, 3200, half).share(OutcomeKind::attracted, 1);
  EXPECT_EQ(cells.share, 0.5);
  EXPECT_EQ(cells.by, IntervalBy::wilson);  // no cell is split
  EXPECT_GT(cells.half_width(), 0.01);
  const Share none = tally_of(sobol, 1, 4096, [](double, double) { return false; }).share(OutcomeKind::attracted, 1);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_EQ(none.high, wilson_share(0, 4096).high);
}

TEST(EvenShares, AnUnfinishedGridIsASampleOfItsCells) {
  const Sampler grid(SamplingMethod::grid, 2, 8192, true);
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Share s = tally_of(grid, seed, 2000, mirrored_discs(0.2)).share(OutcomeKind::attracted, 1);
    EXPECT_EQ(s.by, IntervalBy::wilson);
    covered += s.low <= 0.2 && 0.2 <= s.high;
  }
  EXPECT_GE(covered, 175);  // 95 % of 200 less five standard errors of 3.1
}

TEST(EvenShares, HalfWidthIsLookedAtWhereNetsEnd) {
  const Sampler sampler(SamplingMethod::sobol, 2, 1, false);
  Tally tally(sampler, 1, 0.0);
  std::vector<std::uint64_t> points;
  for (int i = 0; i < 20000; ++i) {
    tally.add({});
    if (tally.at_checkpoint()) points.push_back(tally.total());
  }
  EXPECT_EQ(points, (std::vector<std::uint64_t>{4096, 5120, 6144, 7168, 8192, 10240, 12288, 14336, 16384}));
}

TEST(SamplingChoice, TakesWhatNeedsFewerStarts) {
  // Binomial shares: 0.3 (0.7) within +- 0.001 needs 1.96^2 0.21 / 0.001^2 = 806 733 random starts.
  const auto choose = [](const Set& set) {
    const Sampler sampler(SamplingMethod::sobol, 2, 1, false);
    return choose_sampling(tally_of(sampler, 1, pilot_starts, set).shares(), 0.001);
  };
  const SamplingChoice smooth = choose(disc(0.3));
  EXPECT_EQ(smooth.method, SamplingMethod::sobol);
  EXPECT_NEAR(smooth.random_starts, 806733, 20000);  // the pilot knows 0.21 to 0.0015 at one standard error
  EXPECT_LT(smooth.sobol_starts, 0.5 * smooth.random_starts);
  // For such points, stripes much finer than their spacing are noise.
  const SamplingChoice noise = choose([](double x, double y) { return std::fmod(1e6 * (x + 0.3 * y), 1.0) < 0.3; });
  EXPECT_EQ(noise.pilot, pilot_starts);
  EXPECT_NEAR(noise.random_starts, 806733, 40000);
  EXPECT_EQ(noise.method,
            noise.sobol_starts - 16384 < noise.random_starts ? SamplingMethod::sobol : SamplingMethod::random);
}

TEST(SamplingChoice, PrefersRandomStartsWhereTheSpreadIsNoSmaller) {
  Share wide = wilson_share(8192, 16384);
  wide.by = IntervalBy::replicates;
  wide.low = 0.49;
  wide.high = 0.51;
  const SamplingChoice choice = choose_sampling({wide, wilson_share(0, 16384)}, 0.001);
  EXPECT_EQ(choice.method, SamplingMethod::random);
  EXPECT_NEAR(choice.sobol_starts, 16384 * 100.0, 1.0);  // ten times too wide
  EXPECT_NEAR(choice.random_starts, 960361, 1000);       // 0.25 (1.96 / 0.001)^2
}

TEST(SamplingChoice, RandomStartsNeededAreThoseThatWilsonNeeds) {
  for (const double h : {0.05, 0.01, 0.001}) {
    const auto n = static_cast<std::uint64_t>(std::llround(most_random_starts(h)));
    EXPECT_NEAR(wilson_share(n / 2, n).half_width(), h, 1e-3 * h);  // n is rounded to a start
    const auto m = static_cast<std::uint64_t>(std::llround(random_starts_for({wilson_share(0, 1000)}, h)));
    EXPECT_NEAR(wilson_share(0, m).half_width(), h, 0.02 * h);  // m may be as small as 34
  }
}

}  // namespace even_share_test
}  // namespace equipoise
