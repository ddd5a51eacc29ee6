// Balance quality in words and as JSON.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace equipoise {

/// "G 147 (within grade G 250)" of a balance quality in mm/s; "G 0" of what has less than anybody measures.
std::string grade_text(double grade_mm_s);
/// The figure, and the grade of the standard that it stays within; null beyond all.
nlohmann::ordered_json grade_json(double grade_mm_s);

}  // namespace equipoise
