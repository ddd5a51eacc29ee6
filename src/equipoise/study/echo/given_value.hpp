// Values given next to a study, by options, and its own values for messages: dimensionless numbers, or quantities that
// the study's scales convert.
#pragma once

#include <optional>
#include <string>

#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/units/units.hpp"

namespace equipoise::study {

/// The quantity behind a dimensionless value: what it measures, and one of it in SI units.
struct ValueUnit {
  Dimension dimension{};
  double scale = 1.0;
  std::optional<Dimension> other = {};  ///< that may be given instead, as a study's drag as force for a speed
  double other_scale = 1.0;
};

/// For a dimension that every dimensionless study has (scale_of()); empty if the study has no scales.
std::optional<ValueUnit> unit_of(const Study& study, Dimension dimension);
/// For a dotted key of rotor, balancer or speed. Empty for pure numbers, and for the drag of balls with different
/// masses, where one torque is not one dimensionless number.
std::optional<ValueUnit> unit_of(const Study& study, const std::string& key);

/// A value, or what is wrong with its text.
struct GivenValue {
  double value = 0.0;
  std::string problem;  ///< empty if the value is valid
};

/// Reads a plain number as the dimensionless value, even in a study with scales, and "number unit" by `unit`.
GivenValue read_given(const std::string& text, const std::optional<ValueUnit>& unit);

/// A dimensionless value in the terms of a study with these scales: 3.2, or "0.05 s" and "2400 rpm".
std::string in_own_unit(double value, Dimension dimension, const std::optional<model::Scales>& scales);

/// A key that a study states, and its value in the study's own unit.
struct StatedValue {
  const char* key;
  std::string text;
};
/// What sets the time of release; for an array its last entry.
StatedValue stated_release(const Study& study);

}  // namespace equipoise::study
