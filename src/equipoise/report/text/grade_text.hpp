// Balance quality in words and as JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace equipoise {

/// "G 147 (within grade G 250)" for a balance quality in mm/s; "G 0" below anything measurable.
std::string grade_text(double grade_mm_s);
/// The figure, and the standard's grade that it meets; null beyond all grades.
nlohmann::ordered_json grade_json(double grade_mm_s);

}  // namespace equipoise
