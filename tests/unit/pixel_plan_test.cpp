// Which pixels of a painted slice are computed, and how the others are filled in.
#include "equipoise/analyses/basin_slices/pixel_plan.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/basin_slices/reused_pixels.hpp"
#include "equipoise/analyses/basin_slices/slice_names.hpp"
#include "equipoise/results/result_files/basin_file.hpp"

namespace equipoise {
namespace pixel_plan_test {

using Paint = std::function<short(int column, int row)>;

struct Painted {
  std::vector<SlicePixel> pixels;
  std::uint64_t computed = 0;
  bool twice = false;  // some pixel was requested again
};

// Everything that a plan requests, `most` pixels at a time; filled in by bands of blocks at the end.
Painted painted_by_plan(int columns, int rows, int block, const Paint& paint, std::size_t most = 1000000) {
  PixelPlan plan(columns, rows, block);
  Painted result;
  result.pixels.resize(plan.size());
  for (auto batch = plan.next(most); !batch.empty(); batch = plan.next(most))
    for (const std::uint32_t at : batch) {
      SlicePixel& pixel = result.pixels[at];
      result.twice = result.twice || pixel.computed;
      const int column = static_cast<int>(at) % columns, row = static_cast<int>(at) / columns;
      pixel = {paint(column, row), true, 1.0f};
      pixel.balance_margin = static_cast<float>(2 * column - row);
      plan.know(at, pixel.code);
      ++result.computed;
    }
  EXPECT_EQ(plan.settled(), plan.size());
  plan.close();
  const int band = block > 0 ? 2 * block : rows;
  for (int first = 0; first < rows; first += band)
    plan.fill(first, std::min(band + 1, rows - first), result.pixels.data() + first * columns);
  return result;
}

std::uint64_t wrong(const Painted& map, int columns, const Paint& paint) {
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < map.pixels.size(); ++k)
    count += map.pixels[k].code != paint(static_cast<int>(k) % columns, static_cast<int>(k) / columns);
  return count;
}

short disc(int column, int row) { return std::hypot(column - 60.3, row - 41.7) < 30.0 ? 1 : 2; }

TEST(PixelPlan, WithoutBlocksEveryPixelIsComputed) {
  const Painted map = painted_by_plan(61, 47, 0, disc, 100);
  EXPECT_EQ(map.computed, 61u * 47u);
  EXPECT_EQ(wrong(map, 61, disc), 0u);
  EXPECT_FALSE(map.twice);
}

// A line of basins across the whole slice crosses edges: none is missed, whatever the sides of slice and blocks.
TEST(PixelPlan, WithBlocksLessIsComputedAndALineIsFound) {
  const Paint line = [](int column, int row) -> short { return column == row / 2 + 20 ? 3 : 2; };
  for (const auto& [columns, rows] : {std::pair{128, 96}, {129, 97}, {100, 81}, {130, 66}})
    for (const int block : {2, 8, 16, 64})
      for (const std::size_t most : {std::size_t{50}, std::size_t{1000000}}) {
        for (const Paint& paint : {Paint(disc), line}) {
          const Painted map = painted_by_plan(columns, rows, block, paint, most);
          EXPECT_EQ(wrong(map, columns, paint), 0u) << columns << "x" << rows << " by " << block;
          EXPECT_FALSE(map.twice);
          const std::uint64_t all = static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
          EXPECT_LT(map.computed, block == 2 ? all : all * 2 / 3);
        }
      }
}

// With one outcome only the edges of blocks of 16 are computed: two rows in 16.
TEST(PixelPlan, UniformMapsCostTheirEdges) {
  const Painted map = painted_by_plan(161, 161, 16, [](int, int) -> short { return 1; });
  EXPECT_EQ(map.computed, 161u * 161u - 100u * 15u * 15u);
}

// What the guide says is missed.
TEST(PixelPlan, AnIslandWithinABlockIsMissed) {
  const Paint island = [](int column, int row) -> short { return column / 4 == 1 && row / 4 == 1 ? 2 : 1; };
  EXPECT_EQ(wrong(painted_by_plan(33, 33, 16, island), 33, island), 16u);
  EXPECT_EQ(wrong(painted_by_plan(33, 33, 2, island), 33, island), 0u);
}

TEST(PixelPlan, UndecidedAndFailedAreNoOutcomeToBeFilledIn) {
  for (const short code : {undecided_code, failed_code}) {
    const Painted map = painted_by_plan(40, 40, 8, [&](int, int) { return code; });
    EXPECT_EQ(map.computed, 1600u);
  }
  EXPECT_LT(painted_by_plan(40, 40, 8, [](int, int) { return diverged_code; }).computed, 1600u);
}

// Interpolation between corners reproduces a plane.
TEST(PixelPlan, BalanceIsInterpolatedBetweenCornersAndTimesAreNotMadeUp) {
  const Painted map = painted_by_plan(50, 45, 16, [](int, int) -> short { return 1; });
  for (std::size_t k = 0; k < map.pixels.size(); ++k)  // roundings of numbers up to 100
    EXPECT_NEAR(map.pixels[k].balance_margin, 2.0 * static_cast<double>(k % 50) - static_cast<double>(k / 50), 1e-4);
  EXPECT_FALSE(map.pixels[50 * 5 + 5].computed);
  EXPECT_TRUE(std::isnan(map.pixels[50 * 5 + 5].time));
}

TEST(PixelPlan, SmallMapsArePlanned) {
  for (const auto& [columns, rows] : {std::pair{1, 1}, {1, 9}, {9, 1}, {2, 2}, {3, 2}}) {
    const Painted map = painted_by_plan(columns, rows, 8, [](int column, int) { return short(1 + column % 2); });
    EXPECT_EQ(wrong(map, columns, [](int column, int) { return short(1 + column % 2); }), 0u);
  }
}

// A pixel from a file that differs from its block's edges divides the block.
TEST(PixelPlan, WhatIsKnownWithinABlockCounts) {
  PixelPlan plan(17, 17, 16);
  plan.know(8 * 17 + 5, 2);
  for (auto batch = plan.next(1000); !batch.empty(); batch = plan.next(1000))
    for (const std::uint32_t at : batch) plan.know(at, 1);
  EXPECT_GT(plan.known_count(), 17u * 17u - 15u * 15u + 1u);
}

TEST(SliceNames, OthersThanTheUsualHaveCodesInTheOrderOfPixels) {
  SliceNames names;
  const short late = names.code({"b", "", 0}), usual = names.code({"both captured", "", 0});
  const short early = names.code({"a", "", 0}), own = names.code({"balanced", "", 1});
  EXPECT_EQ(names.code({"b", "", 0}), late);
  EXPECT_EQ(own, 1);
  names.see(late, 70);
  names.see(early, 30);
  names.see(usual, 50);
  names.see(late, 40);
  const auto whole = names.seen(true);
  EXPECT_EQ(whole.size(), 3u);  // balanced was not seen
  EXPECT_EQ(whole.at(early).id + 1, whole.at(late).id);
  EXPECT_EQ(whole.at(usual).id, usual);
  EXPECT_EQ(names.seen(false).at(late).id, late);
}

TEST(ReusedPixels, AreThoseWithTheSameCentre) {
  const SliceAxis coarse{"speed.final", 1.7, 4.1, 8};
  EXPECT_EQ(same_centres(coarse, coarse), (std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7}));
  const SliceAxis finer{"speed.final", 1.7, 4.1, 24};
  const std::vector<int> thirds = same_centres(finer, coarse);
  for (int k = 0; k < 24; ++k) EXPECT_EQ(thirds[static_cast<std::size_t>(k)], k % 3 == 1 ? k / 3 : -1);
  for (const int place : same_centres({"speed.final", 1.7, 4.1, 16}, coarse)) EXPECT_EQ(place, -1);  // between
  EXPECT_EQ(same_centres({"speed.final", 2.3, 2.9, 2}, coarse), (std::vector<int>{2, 3}));
  EXPECT_EQ(same_centres({"speed.final", 3.5, 4.7, 4}, coarse), (std::vector<int>{6, 7, -1, -1}));
}

TEST(ThinnedAxis, KeepsCentres) {
  const SliceAxis axis{"speed.final", -1.0, 2.0, 23};
  for (const int every : {1, 2, 3, 5, 23}) {
    const SliceAxis thin = thinned(axis, every);
    for (int k = 0; k < thin.pixels; ++k)
      EXPECT_NEAR(thin.centre(k), axis.centre(k * every + first_of(every)), 1e-14)
          << every;                                        // roundings of numbers near 1
    EXPECT_GE(first_of(every) + thin.pixels * every, 23);  // no further one is in the slice
  }
}

}  // namespace pixel_plan_test
}  // namespace equipoise
