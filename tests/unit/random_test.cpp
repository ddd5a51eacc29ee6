// Random numbers: known words, first numbers, moments within their standard errors.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "equipoise/core/base/random.hpp"

namespace equipoise {
namespace random_test {

// The generator's published known answer (file kat_vectors of Random123) for a counter and a key of zeros.
TEST(Random, WordsAreThoseOfPhilox) {
  const RandomWords zero = random_words({0, 0}, {0, 0, 0, 0});
  EXPECT_EQ(zero, (RandomWords{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
}

TEST(Random, FractionsLieBelowOne) {
  EXPECT_EQ(fraction(0), 0.0);
  EXPECT_EQ(fraction(~std::uint64_t{0}), 1.0 - 0x1p-53);
}

// Computed by another program with integers of any length. Trapping regions depend on these numbers. Six are more than
// one block.
TEST(Random, StreamsBeginAsTheyAlwaysDid) {
  RandomStream even, bell;
  for (const double expected : {0.10497218847413847, 0.6931135233729437, 0.9764103069660157, 0.4221709537778485,
                                0.19972611387175898, 0.018609283776805707})
    EXPECT_EQ(even.uniform(), expected);
  // The system's logarithm and cosine, to the last digit.
  for (const double expected : {-0.16477211388538707, -2.416652424881293, 0.6629767127656954})
    EXPECT_DOUBLE_EQ(bell.normal(), expected);
  EXPECT_NE(RandomStream(1).uniform(), RandomStream(2).uniform());
}

// Each mean of a power lies within five standard errors, from the moments of the distribution: for N numbers the mean
// of x^k has the variance (m_2k - m_k^2) / N.
TEST(Random, MomentsAreThoseOfTheirDistributions) {
  constexpr int count = 200000;
  RandomStream random;
  double even[5] = {}, bell[5] = {};
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform(), g = random.normal();
    for (int k = 1; k <= 4; ++k) {
      even[k] += std::pow(u, k) / count;
      bell[k] += std::pow(g, k) / count;
    }
  }
  const double moments[9] = {1.0, 0.0, 1.0, 0.0, 3.0, 0.0, 15.0, 0.0, 105.0};  // of the normal distribution
  for (int k = 1; k <= 4; ++k) {
    const double mean = 1.0 / (k + 1), variance = 1.0 / (2 * k + 1) - mean * mean;
    EXPECT_NEAR(even[k], mean, 5.0 * std::sqrt(variance / count)) << k;
    EXPECT_NEAR(bell[k], moments[k], 5.0 * std::sqrt((moments[2 * k] - moments[k] * moments[k]) / count)) << k;
  }
}

// Neighbours share a block of the generator, and a pair makes one normal number.
TEST(Random, NeighboursAreNotCorrelated) {
  constexpr int count = 200000;
  RandomStream random;
  double before = random.normal(), product = 0.0;
  for (int i = 0; i < count; ++i) {
    const double next = random.normal();
    product += before * next / count;
    before = next;
  }
  EXPECT_NEAR(product, 0.0, 5.0 / std::sqrt(count));
}

}  // namespace random_test
}  // namespace equipoise
