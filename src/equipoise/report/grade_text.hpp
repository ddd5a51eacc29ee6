// Balance quality in words.
#pragma once

#include <string>

namespace equipoise {

/// "G 147 (within grade G 250)" of a balance quality in mm/s; "G 0" of what has less than anybody measures.
std::string grade_text(double grade_mm_s);

}  // namespace equipoise
