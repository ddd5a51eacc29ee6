// Densities of what balls are made of. Typical values of a material, within about 1.5 %: weigh a ball where that
// matters.
// This room: what data sheets state (materials, oils, drag in channels, vibration tests), and the scales of a machine.
#pragma once

#include <array>
#include <string_view>

namespace equipoise::model {

struct BallMaterial {
  std::string_view name;
  double density;       ///< kg/m^3
  const char* meaning;  ///< the grade that this is the density of, and its source (docs/reference/references.md)
};

inline constexpr std::array<BallMaterial, 5> ball_materials{{
    {"steel", 7810.0, "bearing steel 100Cr6, AISI 52100 [52100]"},
    {"stainless steel", 7700.0, "X105CrMo17, AISI 440C [440C]"},
    {"tungsten carbide", 14900.0, "with 6 % of cobalt [YG6]"},
    {"ceramic", 3200.0, "silicon nitride [Si3N4]"},
    {"glass", 2500.0, "soda-lime glass [glass]"},
}};

/// Null if no material has the name.
inline const BallMaterial* find_ball_material(std::string_view name) {
  for (const BallMaterial& material : ball_materials)
    if (material.name == name) return &material;
  return nullptr;
}

/// Diameters in mm of a maker's stock list of balls to ISO 3290, metric and inch sizes together [Techno].
inline constexpr std::array<double, 42> stock_ball_diameters{
    1.5,      1.5875,  2.0,      2.38125,  2.5,  2.778125, 3.0,     3.175,  3.5,      3.96875, 4.0,
    4.5,      4.7625,  5.0,      5.55625,  6.0,  6.35,     7.14375, 7.9375, 8.73125,  9.525,   10.0,
    10.31875, 11.1125, 11.90625, 12.0,     12.7, 13.49375, 14.2875, 15.0,   15.08125, 15.875,  16.0,
    16.66875, 17.4625, 19.05,    19.84375, 20.0, 20.6375,  23.8125, 25.0,   25.4};

}  // namespace equipoise::model
