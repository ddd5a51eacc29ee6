// What a study in physical units says of its balls beyond the dimensionless numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "equipoise/study/toml/study_value.hpp"

namespace equipoise {

/// In SI units; empty where the study says nothing.
struct BallDetails {
  std::vector<double> diameter;         ///< one per ball
  std::optional<double> oil_viscosity;  ///< dynamic, Pa s
  std::optional<double> oil_density;    ///< kg/m^3
  std::optional<double> oil_kelvin;     ///< its temperature, of an oil given by its grade
};

/// Reads them from a study text that parse_study() accepts.
BallDetails parse_ball_details(const std::string& toml_text, const std::string& name,
                               const std::vector<std::string>& overrides = {});
/// The same from a tree that study_from() accepts.
BallDetails ball_details_from(const StudyValue& tree, const std::string& name = "study",
                              const std::vector<std::string>& overrides = {});

}  // namespace equipoise
