// Other forms of a study that must have the same answer.
#pragma once

#include <optional>
#include <string>

#include "equipoise/model/scales.hpp"
#include "equipoise/study/study.hpp"

namespace equipoise::audit {

/// Seen in a mirror: everything turns the other way. None where a file cannot say it (a motor's stall torque).
std::optional<Study> mirrored(const Study& study);

/// The balls in the opposite order.
Study reversed(const Study& study);

/// A machine in SI units whose dimensionless form is `study`. None unless the mean stiffness is 1, the unit that
/// machines in physical units have.
std::optional<std::string> physical_text(const Study& study, const model::Scales& scales);

/// Empty if both studies, with their releases stated, hold the same numbers but for 1e-12, units apart; else the first
/// line that differs.
std::string numbers_differ(const Study& a, const Study& b);

}  // namespace equipoise::audit
