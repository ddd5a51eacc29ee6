// Values given beside a study, by options: dimensionless numbers, or quantities that its scales turn into them.
#pragma once

#include <optional>
#include <string>

#include "equipoise/study/study.hpp"
#include "equipoise/units/units.hpp"

namespace equipoise::study {

/// How a dimensionless value is given as a quantity: what it measures, and what one of it is worth in SI units.
struct ValueUnit {
  Dimension dimension{};
  double scale = 1.0;
};

/// Of a dimension that every dimensionless study has (scale_of()); none where the study has no scales.
std::optional<ValueUnit> unit_of(const Study& study, Dimension dimension);
/// Of a key of rotor, balancer or speed, dotted; none for what has no dimension, and for the drag of balls that differ
/// in mass: one torque is then not one number.
std::optional<ValueUnit> unit_of(const Study& study, const std::string& key);

/// A value read; or what is wrong with its text.
struct GivenValue {
  double value = 0.0;
  std::string problem;  ///< empty: the value holds
};

/// Reads a plain number as the dimensionless value, in a study with scales too, and "number unit" by `unit`.
GivenValue read_given(const std::string& text, const std::optional<ValueUnit>& unit);

}  // namespace equipoise::study
