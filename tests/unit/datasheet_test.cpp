// Materials, oils, drag in channels, and what tests of vibration tell: against published values and exact relations.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/core/base/nearest_name.hpp"
#include "equipoise/machine/datasheet/ball_drag.hpp"
#include "equipoise/machine/datasheet/materials.hpp"
#include "equipoise/machine/datasheet/oils.hpp"
#include "equipoise/machine/datasheet/vibration_data.hpp"

namespace equipoise {
namespace datasheet_test {

TEST(BallDrag, WallsMultiplyItAsInTheExactSolution) {
  EXPECT_DOUBLE_EQ(model::stokes_drag(0.1, 8e-3), 3.0 * pi * 0.1 * 8e-3);
  EXPECT_NEAR(model::wall_correction(0.0), 1.0, 1e-6);  // coefficients of six digits
  // Creeping flow around a sphere on the axis of a long tube, solved apart from this code: multipoles in the sphere's
  // centre and Fourier integrals over the wall, to all digits shown. (The table of Happel and Brenner (1983), 7-3.1, is
  // itself up to 1.5 % off these.)
  const std::vector<double> exact{1.26321, 1.67948, 2.37009, 3.59137, 5.94737, 11.0919, 24.6760, 74.6700};
  for (std::size_t k = 0; k < exact.size(); ++k)
    EXPECT_NEAR(model::wall_correction(0.1 * (k + 1)) / exact[k], 1.0, 0.002) << 0.1 * (k + 1);
  // The first reflection from the wall: 1 + 2.10444 of the ratio (Happel and Brenner, 7-3).
  EXPECT_NEAR((model::wall_correction(1e-4) - model::wall_correction(0.0)) / 1e-4, 2.10444, 1e-3);
}

// In a gap that is narrow against the ball, lubrication: 9 pi^2 sqrt(2)/4 (1 - ratio)^(-5/2), over 6 pi.
TEST(BallDrag, OfACloseFitIsThatOfLubrication) {
  const double gap = 1e-4;
  const double lubrication = 9.0 * pi * pi * std::sqrt(2.0) / 4.0 * std::pow(gap, -2.5) / (6.0 * pi);
  EXPECT_NEAR(model::wall_correction(1.0 - gap) / lubrication, 1.0, 2.0 * gap);
}

TEST(BallMaterials, HaveTheirDensities) {
  EXPECT_EQ(model::find_ball_material("steel")->density, 7810.0);
  EXPECT_EQ(model::find_ball_material("ceramic")->density, 3200.0);
  EXPECT_FALSE(model::find_ball_material("cheese"));
  EXPECT_EQ(model::find_ball_material("tungsten carbide")->density, 14900.0);
}

// Calculated apart from this code from the table of ASTM D2270, whose equations are within 0.11 % of it.
TEST(Oils, OfAViscosityIndexHaveTheViscositiesOfTheStandards) {
  struct Grade {
    double at_40, at_100, at_20, at_60;
  };
  for (const Grade& g : {Grade{10, 2.64, 21, 5.8},
                         {32, 5.29, 88, 15.0},
                         {68, 8.53, 218, 28.4},
                         {100, 11.07, 343, 39.6},
                         {220, 18.75, 861, 78.3},
                         {460, 30.34, 2054, 147}}) {
    const double at_100 = *model::viscosity_at_100(g.at_40, 95.0);
    EXPECT_NEAR(at_100, g.at_100, 0.006) << g.at_40;
    const auto at = [&](double celsius) {
      return model::mineral_oil_viscosity(g.at_40, at_100, model::celsius_zero + celsius);
    };
    EXPECT_NEAR(at(40.0) / g.at_40, 1.0, 1e-12);
    EXPECT_NEAR(at(100.0) / at_100, 1.0, 1e-12);
    EXPECT_NEAR(at(20.0) / g.at_20, 1.0, 0.025) << g.at_40;  // given to two or three digits
    EXPECT_NEAR(at(60.0) / g.at_60, 1.0, 0.01) << g.at_40;
  }
  // A worked example of ASTM D2270: 73.30 and 8.86 mm^2/s have the index 92.
  EXPECT_NEAR(*model::viscosity_at_100(73.30, 92.0), 8.86, 0.02);
  EXPECT_FALSE(model::viscosity_at_100(4.6, 95.0));
}

// The standard's own formula for nu from Z, a fit good to about a tenth of a per cent.
TEST(Oils, ThatAreThinFollowTheStandardToo) {
  const double nu = model::mineral_oil_viscosity(2.2, 0.9, model::celsius_zero + 150.0);
  const auto lglg = [](double v) {
    return std::log10(std::log10(v + 0.7 + std::exp(-1.47 - 1.84 * v - 0.51 * v * v)));
  };
  const auto lg = [](double celsius) { return std::log10(model::celsius_zero + celsius); };
  const double number = lglg(2.2) + (lglg(0.9) - lglg(2.2)) / (lg(100.0) - lg(40.0)) * (lg(150.0) - lg(40.0));
  const double z = std::pow(10.0, std::pow(10.0, number)) - 0.7;
  EXPECT_NEAR(nu / (z - std::exp(-0.7487 - 3.295 * z + 0.6119 * z * z - 0.3193 * z * z * z)), 1.0, 0.005);
  EXPECT_GT(std::fabs(nu / z - 1.0), 0.05);  // the term matters here
}

TEST(Oils, OfSiliconeAreFlat) {
  EXPECT_DOUBLE_EQ(model::silicone_viscosity(1000.0, model::celsius_zero + 25.0), 1000.0);
  // The viscosity-temperature coefficient, 1 - nu(210 F)/nu(100 F), of dimethyl silicones is 0.60.
  const auto fahrenheit = [](double f) { return (f + 459.67) * 5.0 / 9.0; };
  const double coefficient =
      1.0 - model::silicone_viscosity(1000.0, fahrenheit(210.0)) / model::silicone_viscosity(1000.0, fahrenheit(100.0));
  EXPECT_NEAR(coefficient, 0.60, 0.01);
}

// By the free vibration itself: x'' + 2 zeta x' + x = 0 falls by exp(-zeta T) in a period T = 2 pi/sqrt(1 - zeta^2).
TEST(VibrationData, IsTheRatioOfTheFreeVibration) {
  for (const double zeta : {0.01, 0.1, 0.5, 0.9}) {
    const double decrement = zeta * 2.0 * pi / std::sqrt(1.0 - zeta * zeta);
    EXPECT_NEAR(model::ratio_of_decrement(decrement), zeta, 1e-15);
    EXPECT_NEAR(model::ratio_of_quality(1.0 / (2.0 * zeta)), zeta, 1e-15);
  }
  EXPECT_EQ(model::ratio_of_decrement(0.0), 0.0);
  EXPECT_DOUBLE_EQ(model::eccentricity_of_grade(6.3e-3, 100.0 * pi), 6.3e-3 / (100.0 * pi));
}

TEST(NearestName, IsTheOneThatWasMeant) {
  const std::vector<std::string> names{"ramp", "constant", "torque"};
  EXPECT_EQ(nearest_name("rmap", names), "ramp");
  EXPECT_EQ(nearest_name("RAMP", names), "ramp");
  EXPECT_EQ(nearest_name("constnat", names), "constant");
  EXPECT_EQ(nearest_name("motor", names), "");
  EXPECT_EQ(nearest_name("x", names), "");
  EXPECT_EQ(did_you_mean("torqe", names), "did you mean \"torque\"? ");
  EXPECT_EQ(did_you_mean("", names), "");
}

}  // namespace datasheet_test
}  // namespace equipoise
