// Notes of results, for the reader of a study.
#pragma once

#include <string>

#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A note about balance (balanced_regions/balanced_analysis.cpp), with its speed and its growth rates in the study's
/// units, to four digits.
std::string note_text(const Study& study, const std::string& note);

}  // namespace equipoise
