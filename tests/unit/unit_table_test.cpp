// The table of units: what each is worth by its definition, and what the table does not have.
#include "equipoise/study/units/unit_table.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "equipoise/core/base/angles.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {
namespace unit_table_test {

struct Worth {
  const char* text;
  double si;
  const char* unit;
};

// Decimal numbers by definition: two roundings at most.
void expect_worth(const std::vector<Worth>& all) {
  for (const auto& [text, si, unit] : all) {
    const auto read = table_unit(text), in = table_unit(unit);
    ASSERT_TRUE(read.has_value() && in.has_value()) << text << ", " << unit;
    EXPECT_DOUBLE_EQ(read->worth_in(*in), si) << text << " in " << unit;
  }
}

TEST(UnitTable, HasMetricUnits) {
  expect_worth({{"g", 1e-3, "kg"},
                {"mg", 1e-6, "kg"},
                {"kilograms", 1.0, "kg"},
                {"t", 1000.0, "kg"},
                {"tonnes", 1000.0, "kg"},
                {"mm", 1e-3, "m"},
                {"um", 1e-6, "m"},
                {"µm", 1e-6, "m"},
                {"μm", 1e-6, "m"},
                {"nm", 1e-9, "m"},
                {"micron", 1e-6, "m"},
                {"millimetres", 1e-3, "m"},
                {"cm", 1e-2, "m"},
                {"ms", 1e-3, "s"},
                {"min", 60.0, "s"},
                {"h", 3600.0, "s"},
                {"day", 86400.0, "s"},
                {"kN", 1e3, "N"},
                {"daN", 10.0, "N"},
                {"MN", 1e6, "N"},
                {"kPa", 1e3, "N/m2"},
                {"bar", 1e5, "Pa"},
                {"mbar", 1e2, "Pa"},
                {"mJ", 1e-3, "N m"},
                {"kW", 1e3, "J/s"},
                {"cSt", 1e-6, "m2/s"},
                {"poise", 0.1, "Pa s"},
                {"cP", 1e-3, "Pa s"},
                {"dyn", 1e-5, "N"},
                {"erg", 1e-7, "J"},
                {"L", 1e-3, "m3"},
                {"ml", 1e-6, "m3"},
                {"kg/L", 1e3, "kg/m3"},
                {"km/h", 1 / 3.6, "m/s"},
                {"kmh", 1 / 3.6, "m/s"},
                {"kph", 1 / 3.6, "m/s"},
                {"degree", pi / 180.0, "rad"},
                {"arcmin", pi / 10800.0, "rad"},
                {"rev", 2.0 * pi, "rad"},
                {"rpm", pi / 30.0, "rad/s"},
                {"rps", 2.0 * pi, "rad/s"},
                {"kHz", 1e3, "1/s"}});
}

// NIST SP 811 (2008), appendix B.8: exact, or to all the digits that it prints.
TEST(UnitTable, HasInchesAndPoundsByDefinition) {
  expect_worth({{"in", 0.0254, "m"},
                {"ft", 0.3048, "m"},
                {"yd", 0.9144, "m"},
                {"mil", 2.54e-5, "m"},
                {"lb", 0.45359237, "kg"},
                {"lbs", 0.45359237, "kg"},
                {"oz", 0.45359237 / 16.0, "kg"},
                {"gravity", 9.80665, "m/s2"},
                {"kgf", 9.80665, "N"},
                {"kp", 9.80665, "N"},
                {"gf", 9.80665e-3, "N"},
                {"lbf", 4.4482216152605, "N"},
                {"ozf", 4.4482216152605 / 16.0, "N"},
                {"slug", 4.4482216152605 / 0.3048, "kg"},
                {"psi", 4.4482216152605 / (0.0254 * 0.0254), "Pa"},
                {"hp", 550.0 * 4.4482216152605 * 0.3048, "W"}});
  EXPECT_NEAR(table_unit("slug")->si, 14.59390, 5e-6);
  EXPECT_NEAR(table_unit("ozf")->si, 0.2780139, 5e-8);
  EXPECT_NEAR(table_unit("psi")->si, 6894.757, 5e-4);
  EXPECT_NEAR(table_unit("hp")->si, 745.6999, 5e-5);
}

TEST(UnitTable, MultipliesAndDivides) {
  expect_worth({{"N/mm", 1e3, "N/m"},
                {"N s/mm", 1e3, "kg/s"},
                {"g mm", 1e-6, "kg m"},
                {"g cm2", 1e-7, "kg m2"},
                {"kg.m^2", 1.0, "kg m2"},
                {"m s-2", 1.0, "m/s^2"},
                {"g/cm3", 1e3, "kg/m3"},
                {"N m/(rad/s)", 1.0, "N m s"},
                {"oz in", 0.0254 * 0.45359237 / 16.0, "kg m"},
                {"lbf/in", 4.4482216152605 / 0.0254, "N/m"},
                {"10 N", 10.0, "N"},
                {"(N s)/m", 1.0, "kg/s"},
                {"rad/min", 1.0 / 60.0, "rad/s"}});
}

TEST(UnitTable, TakesCommonSpellings) {
  expect_worth({{"Nm", 1.0, "N m"},
                {"kNm", 1e3, "N m"},
                {"mNm", 1e-3, "N m"},
                {"Nmm", 1e-3, "N m"},
                {"Ns/m", 1.0, "N s/m"},
                {"Nms", 1.0, "N m s"},
                {"Nm/(rad/s)", 1.0, "N m s"},
                {"mPas", 1e-3, "Pa s"},
                {"gmm", 1e-6, "kg m"},
                {"kgmm", 1e-3, "kg m"},
                {"gcm", 1e-5, "kg m"},
                {"deg", pi / 180.0, "rad"},
                {"lbm", 0.45359237, "kg"},
                {"RPM", pi / 30.0, "rad/s"},
                {"U/min", pi / 30.0, "rad/s"}});
}

TEST(UnitTable, TellsWhatMeasuresSomethingElse) {
  EXPECT_EQ(table_unit("kg")->worth_in(*table_unit("N")), 0.0);
  EXPECT_EQ(table_unit("oz")->worth_in(*table_unit("ozf")), 0.0);
  EXPECT_EQ(table_unit("s")->worth_in(*table_unit("Hz")), 0.0);
  EXPECT_TRUE(table_unit("rpm")->counts_radians());
  EXPECT_TRUE(table_unit("rev/min")->counts_radians());
  for (const char* text : {"Hz", "1/s", "rad2/s", "m/s"}) EXPECT_FALSE(table_unit(text)->counts_radians()) << text;
}

TEST(UnitTable, RefusesWhatItDoesNotHave) {
  for (const char* text :
       {"furlong", "kfoot", "kmin", "mmm", "kkg", "xN", "kgm", "N furlong", "kdeg", "oz_force", "ton"})
    EXPECT_FALSE(table_unit(text).has_value()) << text;
}

TEST(UnitTable, HasTheUnitOfEveryEcho) {
  for (int k = 0; k <= static_cast<int>(Dimension::angle); ++k) {
    const DimensionWords& w = words(static_cast<Dimension>(k));
    for (const char* text : {w.si, w.shown}) EXPECT_TRUE(table_unit(text).has_value()) << text;
  }
}

}  // namespace unit_table_test
}  // namespace equipoise::study
