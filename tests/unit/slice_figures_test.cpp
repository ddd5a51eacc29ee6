// Figures of slices whose basins are known.
#include "equipoise/analyses/basin_slices/slice_figures.hpp"

#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "../support/studies.hpp"

namespace equipoise {
namespace slice_figures_test {

SliceFigures slice_figures(const BasinSlice& map) {
  SliceFigureCount count(map);
  for (int row = 0; row < map.y.pixels; ++row) count.add_row(map.code.data() + map.at(0, row));
  return count.figures();
}

// A square over both angles; `code` gives the code at each pixel's place, 0 to 1.
BasinSlice painted(int side, const std::function<short(double, double)>& code) {
  BasinSlice map;
  map.study = parse_study(constant_speed, "rotor");
  map.x = {"initial.phi_1", 0.0, two_pi, side};
  map.y = {"initial.phi_2", 0.0, two_pi, side};
  for (int row = 0; row < side; ++row)
    for (int column = 0; column < side; ++column) map.code.push_back(code((column + 0.5) / side, (row + 0.5) / side));
  return map;
}

short coin(double x, double y) {
  std::uint64_t h = static_cast<std::uint64_t>(x * 1e9) * 0x9E3779B97F4A7C15u ^
                    static_cast<std::uint64_t>(y * 1e9) * 0xC2B2AE3D27D4EB4Fu;
  h = (h ^ h >> 31) * 0xBF58476D1CE4E5B9u;
  return static_cast<short>(1 + (h >> 40 & 1));
}

TEST(SliceFigures, OfASmoothBoundary) {
  const SliceFigures f = slice_figures(
      painted(512, [](double x, double y) -> short { return std::hypot(x - 0.5, y - 0.5) < 0.3 ? 1 : 2; }));
  ASSERT_TRUE(f.box_dimension && f.uncertainty_exponent);
  EXPECT_NEAR(f.box_dimension->value, 1.0, 0.03);  // a circle of 154 pixels, boxes of up to 64
  EXPECT_NEAR(f.uncertainty_exponent->value, 1.0, 0.03);
  ASSERT_EQ(f.local_exponents.size(), 6u);  // 1, 2, ... 64 pixels
  for (const LocalExponent& e : f.local_exponents) EXPECT_NEAR(e.value, 1.0, 0.1) << e.from;
  EXPECT_LT(f.boundary_basin_entropy->high, std::log(2.0));
  EXPECT_GT(f.basin_entropy->value, 0.0);
}

// Dots of two pixels: the share of unlike pairs is the same at every distance beyond.
TEST(SliceFigures, LocalExponentsShowWhereOnePowerEnds) {
  const SliceFigures f = slice_figures(painted(256, [](double x, double y) -> short {
    return std::fmod(x * 32.0, 1.0) < 0.3 && std::fmod(y * 32.0, 1.0) < 0.3 ? 1 : 2;
  }));
  ASSERT_GE(f.local_exponents.size(), 2u);
  EXPECT_GT(f.local_exponents.front().value, f.local_exponents[1].value + 0.1);
}

// A pixel that is left out is no outcome and does not end the disc around balance.
TEST(SliceFigures, LeaveOutWhatDoesNotCount) {
  const auto disc = [](double x, double y) -> short { return std::hypot(x - 0.5, y - 0.5) < 0.3 ? 1 : 2; };
  const SliceFigures whole = slice_figures(painted(64, disc));
  const SliceFigures less =
      slice_figures(painted(64, [&](double x, double y) -> short { return x == y ? left_out_code : disc(x, y); }));
  EXPECT_NEAR(less.box_dimension->value, whole.box_dimension->value, 0.05);
  EXPECT_EQ(less.balanced_radius, whole.balanced_radius);
}

// The ends of the middle-third Cantor set's gaps, times a line: dimension 1 + log 2 / log 3. Gaps of successive
// generations have alternating colours.
TEST(SliceFigures, OfACantorSetOfLines) {
  const SliceFigures f = slice_figures(painted(729, [](double x, double) -> short {
    int generation = 0;
    for (; generation < 6; ++generation) {
      x *= 3.0;
      const int third = static_cast<int>(x);
      if (third == 1) break;
      x -= third;
    }
    return static_cast<short>(1 + generation % 2);
  }));
  const double dimension = 1.0 + std::log(2.0) / std::log(3.0);
  ASSERT_TRUE(f.box_dimension && f.uncertainty_exponent);
  // Boxes that double do not match gaps that treble: counts vary by a tenth.
  EXPECT_NEAR(f.box_dimension->value, dimension, 0.06);
  EXPECT_NEAR(f.uncertainty_exponent->value, 2.0 - dimension, 0.06);
  EXPECT_LT(f.box_dimension->low, f.box_dimension->value);
}

TEST(SliceFigures, OfChance) {
  const SliceFigures f = slice_figures(painted(500, coin));
  EXPECT_NEAR(f.box_dimension->value, 2.0, 0.05);
  EXPECT_NEAR(f.uncertainty_exponent->value, 0.0, 0.01);
  // The entropy of 25 tosses falls short of log 2 by 1 / 50 on average (G. A. Miller 1955); 10 000 boxes give it to
  // 3e-4.
  EXPECT_NEAR(f.basin_entropy->value, std::log(2.0) - 0.02, 0.002);
  EXPECT_NEAR(f.boundary_basin_entropy->value, f.basin_entropy->value, 1e-3);
}

TEST(SliceFigures, SayNothingOfWhatIsNotThere) {
  const SliceFigures one = slice_figures(painted(256, [](double, double) -> short { return 1; }));
  EXPECT_FALSE(one.box_dimension || one.uncertainty_exponent || one.boundary_basin_entropy);
  EXPECT_EQ(one.basin_entropy->value, 0.0);
  const SliceFigures undecided = slice_figures(
      painted(256, [](double x, double y) -> short { return coin(x, y) == 1 ? undecided_code : short{1}; }));
  EXPECT_FALSE(undecided.box_dimension);
  EXPECT_EQ(undecided.basin_entropy->value, 0.0);
}

// Larger boxes are counted as unions of smaller ones. Compares with boxes examined one by one, on a slice whose sides
// are no multiples of them.
TEST(SliceFigures, BoxesAreThoseThatHoldTwoOutcomes) {
  BasinSlice map = painted(107, [](double x, double y) -> short { return static_cast<short>(1 + (x * x + y > 0.7)); });
  for (std::size_t k = 0; k < map.code.size(); k += 7) map.code[k] = undecided_code;
  std::vector<double> sides, counts;
  for (int side = 1; 8 * side <= 107; side *= 2) {
    double count = 0.0;
    for (int row = 0; row + side < 107; row += side)
      for (int column = 0; column + side < 107; column += side) {
        std::set<short> codes;
        for (int r = row; r <= row + side; ++r)
          for (int c = column; c <= column + side; ++c) codes.insert(map.code[map.at(c, r)]);
        codes.erase(undecided_code);
        count += codes.size() > 1;
      }
    sides.push_back(std::log(side));
    counts.push_back(std::log(count));
  }
  ASSERT_EQ(sides.size(), 4u);
  const double x = (sides[0] + sides[1] + sides[2] + sides[3]) / 4.0;
  double xy = 0.0, xx = 0.0;
  for (int k = 0; k < 4; ++k) {
    xy += (sides[k] - x) * counts[k];
    xx += (sides[k] - x) * (sides[k] - x);
  }
  ASSERT_TRUE(slice_figures(map).box_dimension);
  EXPECT_NEAR(slice_figures(map).box_dimension->value, -xy / xx, 1e-12);  // roundings of sums of four
}

TEST(SliceFigures, BalancedRadiusIsThatOfTheDiscAroundBalance) {
  BasinSlice map = painted(256, [](double, double) -> short { return 2; });
  const auto angles = model::balanced_states(map.study.parameters).angles;
  ASSERT_FALSE(angles.empty());
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column)
      if (std::hypot(wrapped(map.x.centre(column) - angles[0][0]), wrapped(map.y.centre(row) - angles[0][1])) < 1.0)
        map.code[map.at(column, row)] = 1;
  const SliceFigures f = slice_figures(map);
  ASSERT_TRUE(f.balanced_radius);
  EXPECT_LE(*f.balanced_radius, 1.0);
  EXPECT_GT(*f.balanced_radius, 1.0 - 2.0 * two_pi / 256);  // a pixel's diagonal
  map.links = {{2, 1, pi}};
  EXPECT_FALSE(slice_figures(map).balanced_radius);
}

TEST(SliceAxis, IsReadAsPeopleWriteIt) {
  const Study study = parse_study(constant_speed, "rotor");
  const SliceAxis turn = slice_axis(study, "initial.phi_1", "", 4, "--x-range");
  EXPECT_EQ(turn.high, two_pi);
  const SliceAxis part = slice_axis(study, "initial.phi_2", "-pi/2:0.5pi", 4, "--y-range");
  EXPECT_DOUBLE_EQ(part.low, -0.5 * pi);
  EXPECT_DOUBLE_EQ(part.high, 0.5 * pi);
  EXPECT_EQ(slice_axis(study, "rotor.eccentricity", "0:0.1", 4, "--x-range").high, 0.1);
  for (const char* bad : {"", "1", "2:1", "1:2:3", "a:b", "0:nan", "0:inf"})
    EXPECT_THROW(slice_axis(study, "rotor.eccentricity", bad, 4, "--x-range"), InputError) << bad;
  EXPECT_EQ(map_size("300x20", "--size").height, 20);
  for (const char* bad : {"", "300", "300x", "0x3", "3x20001", "-3x3", "3x3x3", "3 x 3"})
    EXPECT_THROW(map_size(bad, "--size"), InputError) << bad;
  const AngleLink link = angle_link("phi_2=phi_1+pi", "--tie");
  EXPECT_EQ(link.ball, 2);
  EXPECT_EQ(link.of, 1);
  EXPECT_DOUBLE_EQ(link.offset, pi);
  EXPECT_EQ(angle_link("phi_3=phi_1", "--tie").offset, 0.0);
  EXPECT_EQ(angle_link("phi_3=phi_1-0.25", "--tie").offset, -0.25);
  for (const char* bad : {"", "phi_2", "phi_2=1", "phi_2=phi_1*2", "phi_2=phi_1+", "phi_2=phi_1+x"})
    EXPECT_THROW(angle_link(bad, "--tie"), InputError) << bad;
}

}  // namespace slice_figures_test
}  // namespace equipoise
