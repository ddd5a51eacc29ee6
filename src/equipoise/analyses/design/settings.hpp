// Values of a candidate's variables as numbers, as text, and in a study's tree.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// A number, or the number of a quantity such as "12 g" in its own unit; 0 for anything else.
double number_of(const StudyValue& value);
/// The unit of a quantity, "g"; empty for anything else.
std::string unit_of_value(const StudyValue& value);
/// The number of a value in this unit; NaN if it is no number, or of another dimension.
double number_in_unit(const StudyValue& value, const std::string& unit);
/// A number with six digits as in a study, with its unit, if it has one.
StudyValue value_of(double number, const std::string& unit, bool whole = false);

/// The place of the entry nearest to a number; `allowed` ascends.
std::size_t nearest_allowed(const std::vector<double>& allowed, double number);

/// The number of one of the variable's choices; of any other value its own.
double allowed_number(const DesignVariable& variable, const StudyValue& value);

/// "balancer.mass=0.05;speed.speeds=[0.0, 2.8];...": candidates with the same text are the same.
std::string text_of(const std::vector<DesignSetting>& settings);
/// A value on one line as TOML; for a spin-up its points.
std::string text_of(const StudyValue& value);

/// The number, quantity or word that a study's tree states under a variable's key; null if there is none.
const StudyValue* stated_in(const StudyValue& tree, const std::string& key);
/// Sets them in a study's tree. A spin-up replaces the whole [speed]; release.time and release.speed replace each
/// other; speed.final of a constant speed is its speed.
void set_in(StudyValue& tree, const std::vector<DesignSetting>& settings);

}  // namespace equipoise
