// Codes and names of a slice's pixels; every so many-th of its pixels.
#include "equipoise/analyses/basin_slices/slice_names.hpp"

#include <gtest/gtest.h>

#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {
namespace slice_names_test {

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

}  // namespace slice_names_test
}  // namespace equipoise
