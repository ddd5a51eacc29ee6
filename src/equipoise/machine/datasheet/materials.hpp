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

}  // namespace equipoise::model
