// The table of usual units against UDUNITS-2: bit-identical values.
#include "equipoise/units/unit_table.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "equipoise/units/unit_library.hpp"
#include "equipoise/units/units.hpp"

namespace equipoise::study {
namespace {

// SI units of everything that a study measures.
const std::vector<std::string> si_units{"kg",  "m",     "s",     "rad/s", "m/s",   "m/s2", "N",    "N/m", "N s/m",
                                        "N m", "N m s", "kg m2", "kg m",  "kg/m3", "Pa s", "m2/s", "rad"};

void expect_same(const std::string& text) {
  const UnitLibraryUse use;
  const Unit theirs(text);
  const auto ours = table_unit(text);
  ASSERT_EQ(ours.has_value(), theirs.is_known()) << text;
  if (!ours) return;
  EXPECT_EQ(ours->radian == 1, theirs.counts_radians()) << text;
  for (const std::string& si : si_units) {
    const double worth = theirs.worth_in(Unit(si));
    // UDUNITS also converts to reciprocals, such as seconds to hertz; those do not count here.
    EXPECT_EQ(ours->same_kind(*table_unit(si)) ? ours->si : 0.0, worth) << text << " in " << si;
  }
}

TEST(UnitTable, HasTheValuesOfUdunits) {
  for (const char* text :
       {"kg",        "g",          "mg",      "t",          "lb",           "gram",       "grams", "kilogram",
        "kilograms", "m",          "mm",      "cm",         "um",           "µm",         "μm",    "nm",
        "km",        "meter",      "metres",  "millimeter", "millimetres",  "in",         "inch",  "ft",
        "feet",      "micron",     "microns", "s",          "ms",           "us",         "min",   "minutes",
        "h",         "hour",       "sec",     "second",     "milliseconds", "rad",        "mrad",  "radian",
        "radians",   "degree",     "degrees", "°",          "turn",         "revolution", "rpm",   "rps",
        "Hz",        "kHz",        "hertz",   "N",          "kN",           "mN",         "MN",    "newton",
        "newtons",   "kilonewton", "Pa",      "kPa",        "mPa",          "J",          "mJ",    "W",
        "kW",        "St",         "cSt",     "bar",        "gravity",      "kgf",        "lbf",   "psi",
        "poise",     "centipoise"})
    expect_same(text);
}

TEST(UnitTable, HasTheProductsOfUdunits) {
  for (const char* text :
       {"kN/m",   "MN/m",           "N/mm",  "kN/mm",   "N s/m",    "N.s/m",      "N s/mm",      "kg/s",   "N m",
        "N mm",   "kN m",           "mN m",  "kg m2",   "kg mm2",   "g mm2",      "g cm2",       "kg.m2",  "kg m^2",
        "g mm",   "g.mm",           "kg mm", "g cm",    "m/s",      "mm/s",       "m/s2",        "mm/s2",  "m/s^2",
        "m s-2",  "m.s^-2",         "rad/s", "rad/min", "degree/s", "kg/m3",      "g/cm3",       "g/mm3",  "Pa s",
        "mPa s",  "mPa.s",          "m2/s",  "mm2/s",   "N m s",    "N m s/rad",  "N m/(rad/s)", "N mm s", "lb in2",
        "lb in",  "lb/ft3",         "10 N",  "1000 kg", "60 s",     "(lb/16) in", "(lbf/16) in", "lbf/in", "lbf s/in",
        "kgf m2", "revolution/min", "min-1", "1/s",     "1/min",    "s-1",        "kg*m2",       "N/m/s",  "(N s)/m"})
    expect_same(text);
}

TEST(UnitTable, RefusesWhatItDoesNotHave) {
  for (const char* text : {"furlong", "kfoot", "kmin", "mmm", "kkg", "xN", "Nm", "N furlong", "deg", "oz_force"})
    EXPECT_FALSE(table_unit(text).has_value()) << text;
}

TEST(UnitTable, HasTheUnitOfEveryEcho) {
  for (int k = 0; k <= static_cast<int>(Dimension::angle); ++k) {
    const DimensionWords& w = words(static_cast<Dimension>(k));
    for (const char* text : {w.si, w.shown}) EXPECT_TRUE(table_unit(text).has_value()) << text;
  }
}

}  // namespace
}  // namespace equipoise::study
