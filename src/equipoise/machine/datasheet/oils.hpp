// Viscosity of oils by grade and temperature.
#pragma once

#include <array>
#include <optional>

namespace equipoise::model {

inline constexpr double celsius_zero = 273.15;  ///< K

/// The classes of ISO 3448: kinematic viscosity in mm^2/s at 40 degC, in the middle of a class of +-10 %.
inline constexpr std::array<double, 20> iso_viscosity_grades{2.2,   3.2,   4.6,    6.8,    10.0,   15.0,  22.0,
                                                             32.0,  46.0,  68.0,   100.0,  150.0,  220.0, 320.0,
                                                             460.0, 680.0, 1000.0, 1500.0, 2200.0, 3200.0};

/// What is taken of a mineral oil that says no more: straight oils of paraffinic base have about this index.
inline constexpr double usual_viscosity_index = 95.0;
inline constexpr double mineral_oil_density = 870.0;  ///< kg/m^3
/// Least viscosity in mm^2/s at 100 degC for which viscosity indices are defined (ASTM D2270, ISO 2909).
inline constexpr double least_indexed_viscosity = 2.0;
inline constexpr double coldest_mineral_oil = celsius_zero - 20.0, hottest_mineral_oil = celsius_zero + 150.0;

/// Kinematic viscosity in mm^2/s at 100 degC of an oil with this viscosity at 40 degC and this index from 0 to 100
/// (ASTM D2270, procedure A). Empty if it is less than least_indexed_viscosity.
std::optional<double> viscosity_at_100(double at_40, double viscosity_index);

/// Kinematic viscosity in mm^2/s at `kelvin` of an oil known at 40 and 100 degC: Ubbelohde and Walther,
/// lg lg Z = A - B lg T with Z = nu + 0.7 + exp(-1.47 - 1.84 nu - 0.51 nu^2) (ASTM D341, for 0.21 mm^2/s and more).
/// Needs at_40 > at_100 > 0.3.
double mineral_oil_viscosity(double at_40, double at_100, double kelvin);

/// Of dimethyl silicone oils. The limits of viscosity and temperature are ours: thinner ones follow the law less well,
/// and above 200 degC the oil oxidises.
inline constexpr double silicone_density = 970.0;  ///< kg/m^3, at 25 degC
inline constexpr double thinnest_silicone = 100.0, thickest_silicone = 1e5;
inline constexpr double coldest_silicone = celsius_zero - 25.0, hottest_silicone = celsius_zero + 200.0;
/// lg nu = lg nu_25 + 763.1 K (1/T - 1/298.15 K) [silicone], which makes the viscosity-temperature coefficient 0.60.
double silicone_viscosity(double at_25, double kelvin);

}  // namespace equipoise::model
