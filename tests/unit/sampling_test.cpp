// Scrambled Sobol points and jittered grids: nets, addressing, uniformity, cells.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/study/sampling/sampling.hpp"
#include "equipoise/study/sampling/scrambled_sobol.hpp"
#include "equipoise/study/sampling/starts.hpp"

namespace equipoise {
namespace sampling_test {

using Points = std::vector<std::vector<double>>;

// The first `count` points of a replicate.
Points replicate(std::uint64_t seed, int number, std::size_t count, int dimensions) {
  Points points(count, std::vector<double>(static_cast<std::size_t>(dimensions)));
  for (std::size_t i = 0; i < count; ++i)
    sobol_fractions(seed, i * sobol_replicates + static_cast<std::size_t>(number), 0, dimensions, points[i].data());
  return points;
}

// Number of points in the fullest and the emptiest box with sides 2^-splits[d].
std::pair<int, int> fullest_and_emptiest(const Points& points, const std::vector<int>& splits) {
  int bits = 0;
  for (const int s : splits) bits += s;
  std::vector<int> boxes(std::size_t{1} << bits);
  for (const auto& x : points) {
    std::size_t box = 0;
    for (std::size_t d = 0; d < splits.size(); ++d)
      box = (box << splits[d]) + static_cast<std::size_t>(std::ldexp(x[d], splits[d]));
    ++boxes[box];
  }
  const auto [low, high] = std::minmax_element(boxes.begin(), boxes.end());
  return {*high, *low};
}

TEST(ScrambledSobol, EveryElementaryIntervalOfTwoAnglesIsHitOnce) {
  constexpr int k = 10;
  for (const int number : {0, 1, 15}) {
    const Points points = replicate(3, number, 1 << k, 2);
    for (int a = 0; a <= k; ++a)
      EXPECT_EQ(fullest_and_emptiest(points, {a, k - a}), std::make_pair(1, 1)) << number << ": " << a;
  }
}

TEST(ScrambledSobol, BlocksBeyondTheFirstAreNetsToo) {
  constexpr int k = 8;
  Points points = replicate(3, 5, 3 << k, 2);
  points.erase(points.begin(), points.begin() + (2 << k));
  for (int a = 0; a <= k; ++a) EXPECT_EQ(fullest_and_emptiest(points, {a, k - a}), std::make_pair(1, 1)) << a;
}

// Joe and Kuo's sequence has t = 1 in three dimensions and t = 3 in four: boxes of volume 2^(t - k) hold 2^t points.
TEST(ScrambledSobol, ThreeAndFourAnglesHaveTheSequencesQuality) {
  constexpr int k = 9;
  const Points points = replicate(1, 2, 1 << k, 4);
  for (int a = 0; a <= k - 1; ++a)
    for (int b = 0; a + b <= k - 1; ++b)
      EXPECT_EQ(fullest_and_emptiest(points, {a, b, k - 1 - a - b}), std::make_pair(2, 2)) << a << " " << b;
  for (int a = 0; a <= k - 3; ++a)
    for (int b = 0; a + b <= k - 3; ++b)
      for (int c = 0; a + b + c <= k - 3; ++c)
        EXPECT_EQ(fullest_and_emptiest(points, {a, b, c, k - 3 - a - b - c}), std::make_pair(8, 8));
}

// Sobol's property A: of each 2^d points in d dimensions one lies in each of the boxes that halve every side. It holds
// if the matrix of first bits, by dimension and by power of two in the point's number, is regular modulo 2. Scrambling
// flips all first bits of a dimension alike.
TEST(ScrambledSobol, AllCoordinatesTogetherHavePropertyA) {
  constexpr int n = most_sobol_dimensions;
  const auto first_bits = [](std::uint64_t number) {
    std::array<double, n> x{};
    sobol_fractions(7, number * sobol_replicates, 0, n, x.data());
    std::uint64_t bits = 0;
    for (std::size_t d = 0; d < n; ++d) bits |= std::uint64_t{x[d] >= 0.5} << d;
    return bits;
  };
  std::vector<std::uint64_t> columns;
  for (int j = 0; j < n; ++j) columns.push_back(first_bits(std::uint64_t{1} << j) ^ first_bits(0));
  int rank = 0;
  for (int d = 0; d < n; ++d) {
    const auto has = [d](std::uint64_t column) { return (column >> d & 1) != 0; };
    const auto pivot = std::find_if(columns.begin() + rank, columns.end(), has);
    if (pivot == columns.end()) continue;
    std::swap(*pivot, columns[static_cast<std::size_t>(rank)]);
    const std::uint64_t taken = columns[static_cast<std::size_t>(rank++)];
    for (auto c = columns.begin() + rank; c != columns.end(); ++c)
      if (has(*c)) *c ^= taken;
  }
  EXPECT_EQ(rank, n);
}

TEST(ScrambledSobol, EveryCoordinateIsStratified) {
  constexpr int k = 10;
  const Points points = replicate(7, 11, 1 << k, most_sobol_dimensions);
  for (std::size_t d = 0; d < most_sobol_dimensions; ++d) {
    std::set<int> cells;
    for (const auto& x : points) {
      ASSERT_GE(x[d], 0.0);
      ASSERT_LT(x[d], 1.0);
      cells.insert(static_cast<int>(std::ldexp(x[d], k)));
    }
    EXPECT_EQ(cells.size(), points.size()) << d;
  }
}

TEST(ScrambledSobol, AStartIsAFunctionOfSeedAndIndexAlone) {
  double bulk[8], alone[1], other[8];
  sobol_fractions(5, 123456789012, 0, 8, bulk);
  for (int d = 0; d < 8; ++d) {
    sobol_fractions(5, 123456789012, d, 1, alone);
    EXPECT_EQ(alone[0], bulk[d]);
  }
  sobol_fractions(6, 123456789012, 0, 8, other);
  for (int d = 0; d < 8; ++d) EXPECT_NE(other[d], bulk[d]);
  const Sampler sampler(SamplingMethod::sobol, 2, 1000, true), shorter(SamplingMethod::sobol, 2, 10, true);
  double phi[2], again[2];
  sampler.angles(5, 77, phi);
  shorter.angles(5, 77, again);  // the number of starts does not matter: runs can be extended
  EXPECT_EQ(phi[0], again[0]);
  EXPECT_EQ(phi[1], again[1]);
}

// If the scrambling is independent, so are the first 53 bits of a point, and those of two points, over replicates and
// seeds.
TEST(ScrambledSobol, EachPointIsUniformAndReplicatesAreIndependent) {
  constexpr int seeds = 4000;
  double mean = 0.0, square = 0.0, between_replicates = 0.0, between_angles = 0.0, within = 0.0;
  for (int seed = 0; seed < seeds; ++seed) {
    double a[2], b[2], next[2];
    sobol_fractions(static_cast<std::uint64_t>(seed), 16 * 9, 0, 2, a);
    sobol_fractions(static_cast<std::uint64_t>(seed), 16 * 9 + 1, 0, 2, b);
    sobol_fractions(static_cast<std::uint64_t>(seed), 16 * 8, 0, 2, next);  // differs from point 9 in its first bit
    mean += a[0] / seeds;
    square += 12.0 * (a[0] - 0.5) * (a[0] - 0.5) / seeds;
    between_replicates += 12.0 * (a[0] - 0.5) * (b[0] - 0.5) / seeds;
    between_angles += 12.0 * (a[0] - 0.5) * (a[1] - 0.5) / seeds;
    within += 12.0 * (a[0] - 0.5) * (next[0] - 0.5) / seeds;
  }
  // Five standard errors: 0.29 and 0.89 of one number, 1 of a product, over sqrt(seeds) = 63.
  EXPECT_NEAR(mean, 0.5, 5 * 0.29 / 63.2);
  EXPECT_NEAR(square, 1.0, 5 * 0.9 / 63.2);
  EXPECT_NEAR(between_replicates, 0.0, 5 / 63.2);
  EXPECT_NEAR(between_angles, 0.0, 5 / 63.2);
  // Two points in different halves, each uniform in its own: E (a - 1/2)(b - 1/2) = -1/16, times 12.
  EXPECT_NEAR(within, -0.75, 5 / 63.2);
}

// Nested scrambling, not a shift: points that share their first j bits keep sharing them, and the next bits are random.
TEST(ScrambledSobol, ScramblingIsNested) {
  const Points one = replicate(1, 0, 64, 1), two = replicate(2, 0, 64, 1);
  int same_flips = 0, pairs = 0;
  for (std::size_t i = 0; i < 64; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const auto shared = [&](const Points& p) {
        int bits = 0;
        while (std::floor(std::ldexp(p[i][0], bits + 1)) == std::floor(std::ldexp(p[j][0], bits + 1))) ++bits;
        return bits;
      };
      ASSERT_EQ(shared(one), shared(two));
      ++pairs;
      const auto top = [&](double x) { return static_cast<unsigned>(std::ldexp(x, 6)); };
      same_flips += (top(one[i][0]) ^ top(two[i][0])) == (top(one[j][0]) ^ top(two[j][0]));
    }
  // A mere digital shift flips the same bits of all points. With random flips six bits agree in 1 of 64 pairs, and more
  // often for pairs with shared bits: 1/64 sum over shared bits s of 2^-(s+1) 2^s = 6/2 times 1/64 = 5 %.
  EXPECT_LT(same_flips, pairs / 5);
}

TEST(JitteredGrid, FillsWithTheStartsItIsGiven) {
  const JitteredGrid plain(2, false, 20000), folded(2, true, 20000);
  EXPECT_EQ(plain.side(), 100u);
  EXPECT_EQ(plain.cells(), 10000u);
  EXPECT_EQ(folded.side(), 140u);  // 140 * 141 / 2 = 9870, and 141 * 142 / 2 = 10011 is too many
  EXPECT_EQ(folded.cells(), 9870u);
  EXPECT_EQ(folded.starts(), 19740u);
  EXPECT_EQ(folded.all_cells(), 19600.0);
  EXPECT_EQ(JitteredGrid(8, true, 2).cells(), 1u);
  EXPECT_EQ(JitteredGrid(1, true, 1001).cells(), 500u);
  EXPECT_EQ(JitteredGrid(8, true, 1000000).side(), 16u);  // C(23, 8) = 490314
  EXPECT_EQ(JitteredGrid(2, false, 1000000000000).side(), 707106u);
}

// Every cell once, in a different order for each seed; two starts in each; weights add up to the whole.
void expect_tiling(int balls, bool exchange, std::uint64_t starts) {
  const JitteredGrid grid(balls, exchange, starts);
  std::map<std::vector<int>, int> visits;
  std::vector<double> phi(static_cast<std::size_t>(balls)), first(phi);
  double weight = 0.0;
  int in_place = 0;
  for (std::uint64_t i = 0; i < grid.starts(); ++i) {
    grid.angles(4, i, phi.data());
    std::vector<int> cell;
    for (const double angle : phi) {
      ASSERT_GE(angle, 0.0);
      ASSERT_LT(angle, two_pi);
      cell.push_back(static_cast<int>(angle / two_pi * static_cast<double>(grid.side())));
    }
    if (exchange) {
      EXPECT_TRUE(std::is_sorted(cell.begin(), cell.end()));
    }
    ++visits[cell];
    weight += 0.5 * grid.weight(4, i);
    EXPECT_EQ(grid.weight(4, i), grid.weight(4, i ^ 1));
    if (i % 2 == 1) {
      EXPECT_NE(phi, first);
    }
    first = phi;
    grid.angles(5, i, phi.data());
    in_place += static_cast<int>(phi[0] / two_pi * static_cast<double>(grid.side())) == cell[0];
  }
  EXPECT_EQ(visits.size(), grid.cells());
  for (const auto& [cell, count] : visits) EXPECT_EQ(count, 2);
  EXPECT_EQ(weight, grid.all_cells());
  EXPECT_LT(in_place, static_cast<int>(grid.starts() / 2));
}

TEST(JitteredGrid, TilesTheTorus) {
  expect_tiling(2, false, 1000);
  expect_tiling(2, true, 1000);
  expect_tiling(3, true, 3000);
  expect_tiling(3, false, 3000);
  expect_tiling(4, true, 4000);
}

TEST(Sampler, RandomStartsAreWhatTheyWere) {
  const Sampler sampler(SamplingMethod::random, 3, 100, true);
  double a[3], b[3];
  sampler.angles(9, 1234, a);
  start_angles(9, 1234, 3, b);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(a[i], b[i]);
  EXPECT_EQ(sampler.weight(9, 1234), 1.0);
}

}  // namespace sampling_test
}  // namespace equipoise
