// Values of a candidate's variables: as numbers, as text, and set in a study's tree.
#pragma once

#include <string>
#include <vector>

#include "equipoise/results/design_result.hpp"

namespace equipoise {

/// A number, or that of a quantity "12 g" in its own unit; 0 of anything else.
double number_of(const StudyValue& value);
/// The unit of a quantity, "g"; empty of anything else.
std::string unit_of_value(const StudyValue& value);
/// A number with six digits as a study has it: with its unit, if it has one.
StudyValue value_of(double number, const std::string& unit, bool whole = false);

/// "balancer.mass=0.05;speed.speeds=[0.0, 2.8];...": two candidates with the same text are the same.
std::string text_of(const std::vector<DesignSetting>& settings);
/// A value on one line, as TOML has it; of a spin-up its points.
std::string text_of(const StudyValue& value);

/// Sets them in a study's tree. A spin-up takes the place of the whole [speed]; of release.time and release.speed the
/// one that is set takes the place of the other; speed.final of a constant speed is its speed.
void set_in(StudyValue& tree, const std::vector<DesignSetting>& settings);

}  // namespace equipoise
