// Rates at which something ends that ends at random.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "equipoise/core/base/random.hpp"
#include "equipoise/core/statistics/escape_rate.hpp"

namespace equipoise {
namespace escape_rate_test {

// Garwood (1936), table of limits for Poisson counts: 0: 0 to 3.69; 1: 0.0253 to 5.57; 10: 4.80 to 18.39.
TEST(EscapeRate, HasGarwoodsInterval) {
  struct Limits {
    std::uint64_t escapes;
    double low, high;
  };
  for (const auto& [escapes, low, high] : {Limits{0, 0.0, 3.689}, {1, 0.0253, 5.572}, {10, 4.795, 18.390}}) {
    const EscapeRate r = escape_rate(escapes, 20, 2.0);
    EXPECT_NEAR(r.low, low / 2.0, 5e-4);
    EXPECT_NEAR(r.high, high / 2.0, 5e-4);
    EXPECT_DOUBLE_EQ(r.rate, static_cast<double>(escapes) / 2.0);
    EXPECT_DOUBLE_EQ(r.least, std::numbers::ln2 / r.high);
  }
  EXPECT_TRUE(std::isinf(escape_rate(0, 20, 2.0).most));
}

// Lifetimes are cut off at 1, and most are longer.
TEST(EscapeRate, OfCutLifetimesHoldsInNineteenOfTwenty) {
  RandomStream random;
  const double truth = 0.4;
  int held = 0;
  constexpr int samples = 1000;
  for (int k = 0; k < samples; ++k) {
    std::uint64_t escapes = 0;
    double watched = 0.0;
    for (int i = 0; i < 50; ++i) {
      const double life = -std::log1p(-random.uniform()) / truth;
      escapes += life < 1.0;
      watched += std::min(life, 1.0);
    }
    const EscapeRate r = escape_rate(escapes, 50, watched);
    held += r.low < truth && truth < r.high;
  }
  // Four standard errors below 95 %; the exact interval errs on the wide side.
  EXPECT_GT(held, 922);
  EXPECT_LT(held, samples - 10);
}

}  // namespace escape_rate_test
}  // namespace equipoise
