// Searches on problems with known solutions: convex fronts, optima inside a cube, and the results of methods that do
// not learn with equally many points.
#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "equipoise/analyses/design/search.hpp"
#include "equipoise/core/base/random.hpp"

namespace equipoise {
namespace design_search_test {

using Worths = std::vector<SearchWorth>;
using Toy = std::function<SearchWorth(const SearchPoint&)>;

// Worths of all `points` points.
Worths searched(DesignMethod method, std::size_t dimensions, std::size_t objectives, std::uint64_t points,
                std::uint64_t seed, const Toy& toy, std::vector<SearchPoint>* at = nullptr) {
  Worths all;
  search(method, {dimensions, objectives, points}, seed, [&](const std::vector<SearchPoint>& batch) {
    Worths worths;
    for (const SearchPoint& x : batch) {
      if (all.size() == points) throw SearchOver();
      EXPECT_EQ(x.size(), dimensions);
      for (const double v : x) EXPECT_TRUE(v >= 0.0 && v <= 1.0) << v;
      worths.push_back(toy(x));
      all.push_back(worths.back());
      if (at) at->push_back(x);
    }
    return worths;
  });
  return all;
}

double least(const Worths& worths) {
  double best = worths.front().front();
  for (const SearchWorth& w : worths) best = std::min(best, w.front());
  return best;
}

// E. Zitzler, K. Deb and L. Thiele, Evol. Comput. 8 (2000) 173: the front is f2 = 1 - sqrt(f1), convex.
SearchWorth zdt1(const SearchPoint& x) {
  double g = 1.0;
  for (std::size_t k = 1; k < x.size(); ++k) g += 9.0 * x[k] / static_cast<double>(x.size() - 1);
  return {x[0], g * (1.0 - std::sqrt(x[0] / g))};
}

// Area up to (1.1, 1.1) dominated by the points.
double dominated_area(Worths worths) {
  std::sort(worths.begin(), worths.end());
  double area = 0.0, low = 1.1;
  for (const SearchWorth& w : worths) {
    if (w[0] >= 1.1 || w[1] >= low) continue;
    area += (1.1 - w[0]) * (low - w[1]);
    low = w[1];
  }
  return area;
}

#define NEEDS_OPTIMISERS() \
  if (!optimisers_built_in()) GTEST_SKIP() << "built without pagmo2"

TEST(DesignSearch, ConvexFrontIsFoundToOnePercent) {
  NEEDS_OPTIMISERS();
  const double exact = 1.21 - 1.0 / 3.0;  // of the whole front
  for (const std::uint64_t seed : {1, 2, 3}) {
    const double area = dominated_area(searched(DesignMethod::nsga2, 4, 2, 4000, seed, zdt1));
    EXPECT_GT(area, 0.99 * exact) << seed;
    EXPECT_LT(area, exact) << seed;
  }
}

TEST(DesignSearch, ConvexOptimumIsFoundToOnePercentOfTheRange) {
  NEEDS_OPTIMISERS();
  const SearchPoint centre{0.31, 0.77, 0.5, 0.05};
  for (const std::uint64_t seed : {1, 2, 3}) {
    const double best = least(searched(DesignMethod::cmaes, 4, 1, 1000, seed, [&](const SearchPoint& x) {
      double sum = 0.0;
      for (std::size_t k = 0; k < x.size(); ++k) sum += (k + 1.0) * (x[k] - centre[k]) * (x[k] - centre[k]);
      return SearchWorth{sum};
    }));
    EXPECT_LT(best, 1e-4) << seed;  // the square of one percent
  }
}

// Like a share of starts in a design: flat far away, steps of 1/1000, best on a narrow ridge.
SearchWorth share_like(const SearchPoint& x) {
  const double along = x[0] - 0.3 - 0.4 * x[1], across = x[1] - 0.62, depth = x[2] - 0.2;
  const double share = std::exp(-30.0 * along * along - 6.0 * across * across - 8.0 * depth * depth);
  return {-std::round(1000.0 * share) / 1000.0};
}

TEST(DesignSearch, OptimiserIsAtLeastAsGoodAsSearchesThatDoNotLearn) {
  NEEDS_OPTIMISERS();
  constexpr std::uint64_t points = 300;
  int at_least_as_good = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    at_least_as_good += least(searched(DesignMethod::cmaes, 3, 1, points, seed, share_like)) <=
                        least(searched(DesignMethod::latin, 3, 1, points, seed, share_like));
  EXPECT_GE(at_least_as_good, 9);
}

TEST(DesignSearch, SamePointsForTheSameSeedAndOthersForAnother) {
  for (const DesignMethod method : {DesignMethod::cmaes, DesignMethod::latin}) {
    if (method == DesignMethod::cmaes && !optimisers_built_in()) continue;
    std::vector<SearchPoint> first, second, other;
    searched(method, 3, 1, 200, 5, share_like, &first);
    searched(method, 3, 1, 200, 5, share_like, &second);
    searched(method, 3, 1, 200, 6, share_like, &other);
    EXPECT_EQ(first, second);
    EXPECT_NE(first, other);
  }
}

TEST(DesignSearch, LatinHypercubeHasOnePointInEveryPartOfEveryCoordinate) {
  RandomStream draws(3);
  const auto points = search_methods::latin_hypercube(3, 20, draws);
  for (std::size_t d = 0; d < 3; ++d) {
    std::vector<int> parts;
    for (const SearchPoint& x : points) parts.push_back(static_cast<int>(20.0 * x[d]));
    std::sort(parts.begin(), parts.end());
    for (int k = 0; k < 20; ++k) EXPECT_EQ(parts[static_cast<std::size_t>(k)], k);
  }
}

}  // namespace design_search_test
}  // namespace equipoise
