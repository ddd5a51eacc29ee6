// Other forms of a study that must have the same result.
#pragma once

#include <optional>
#include <string>

#include "equipoise/machine/datasheet/scales.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::audit {

/// Mirrored: everything turns the other way. Empty where a file cannot express it (a motor's stall torque).
std::optional<Study> mirrored(const Study& study);

/// The balls in the opposite order.
Study reversed(const Study& study);

/// A machine in SI units whose dimensionless form is `study`. Empty unless the mean stiffness is 1, the unit of
/// machines in physical units.
std::optional<std::string> physical_text(const Study& study, const model::Scales& scales);

/// Empty if both studies, with their releases stated, have the same numbers to 1e-12, whatever the units; else the
/// first line that differs.
std::string numbers_differ(const Study& a, const Study& b);

}  // namespace equipoise::audit
