// How many pixels of a basin slice end elsewhere when followed to a finer tolerance, against two whole slices.
#include <cstddef>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "../support/files.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace tolerance_flips_test {

// Long transient chaos: basins are finely interwoven.
Study rotor(double tolerance) {
  Study study = parse_study(constant_speed, "rotor", {"balancer.drag=0.01", "speed.speed=4.0"});
  study.numerics.tolerance = tolerance;
  return study;
}

// 64 columns and 66 rows meet no diagonal, on which the balls would be in one place.
BasinSliceSettings plane(int columns = 64, int rows = 66) {
  BasinSliceSettings s;
  s.x = {"initial.phi_1", 0.0, two_pi, columns};
  s.y = {"initial.phi_2", 0.0, two_pi, rows};
  return s;
}

std::string name_at(const BasinSlice& map, std::size_t at) {
  for (const OutcomeShare& c : map.codes)
    if (c.id == map.code[at]) return c.name;
  return "";
}

TEST(ToleranceFlips, AreAsFrequentAsBetweenTwoSlices) {
  const BasinSlice coarse = basin_slice(rotor(1e-2), plane()), fine = basin_slice(rotor(1e-5), plane());
  double differ = 0.0;
  for (std::size_t k = 0; k < fine.code.size(); ++k) differ += name_at(coarse, k) != name_at(fine, k);
  const double share = differ / static_cast<double>(fine.code.size());
  ASSERT_TRUE(coarse.figures.flipped);
  const Share& flipped = *coarse.figures.flipped;
  EXPECT_EQ(flipped.total, 132u);  // a 32nd
  EXPECT_GT(flipped.count, 1u);    // or the test says little
  EXPECT_LT(flipped.low, share);
  EXPECT_GT(flipped.high, share);
  const std::string text = "a tolerance 1000 times finer, " + std::to_string(flipped.count) + " of 132 pixels tried";
  EXPECT_NE(result_text(coarse).find(text), std::string::npos) << result_text(coarse);
}

TEST(ToleranceFlips, AreNotTriedWhereTheyWouldSayLittle) {
  EXPECT_FALSE(basin_slice(rotor(1e-6), plane(40, 42)).figures.flipped);
  EXPECT_FALSE(
      basin_slice(parse_study(constant_speed, "rotor", {"numerics.tolerance=1e-12"}), plane()).figures.flipped);
}

TEST(ToleranceFlips, AreTheSameForAnyThreadsStopsAndFiles) {
  BasinSliceSettings settings = plane();
  settings.threads = 3;
  settings.output = scratch_file("flips.nc");
  const BasinSlice whole = basin_slice(rotor(1e-4), settings);
  const std::string expected = content(settings.output);
  settings.threads = 1;
  settings.output = scratch_file("flips_stopped.nc");
  StopFlag stop{false};
  settings.stop = &stop;
  settings.progress = [&](const Progress& p) { stop = stop || (!p.preparing && p.done == p.total); };
  EXPECT_FALSE(basin_slice(rotor(1e-4), settings).complete);  // pixels are done, flips are not
  settings.stop = nullptr;
  const BasinSlice resumed = basin_slice(rotor(1e-4), settings);
  EXPECT_TRUE(resumed.complete);
  EXPECT_EQ(content(settings.output), expected);
  const BasinSlice read = basin_slice(rotor(1e-4), settings);
  EXPECT_TRUE(read.read_whole);
  for (const BasinSlice* map : {&resumed, &read}) {
    ASSERT_TRUE(map->figures.flipped);
    EXPECT_EQ(map->figures.flipped->count, whole.figures.flipped->count);
    EXPECT_EQ(map->figures.flipped->high, whole.figures.flipped->high);
  }
}

// Where every line has a rotor of its own.
TEST(ToleranceFlips, AreThoseOfPixelsThatHaveTheirOwnRotors) {
  BasinSliceSettings settings = plane();
  settings.x = {"rotor.eccentricity", 0.0099, 0.0101, 64};
  const BasinSlice map = basin_slice(rotor(1e-2), settings);
  ASSERT_TRUE(map.figures.flipped);
  EXPECT_EQ(map.figures.flipped->total, 132u);
  EXPECT_GT(map.figures.flipped->count, 0u);
}

}  // namespace tolerance_flips_test
}  // namespace equipoise
