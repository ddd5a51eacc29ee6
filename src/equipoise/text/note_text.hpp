// Notes of results, for the reader of a study.
#pragma once

#include <string>

#include "equipoise/study/study.hpp"

namespace equipoise {

/// A note about balance (words/proof.hpp), with its speed and its growth rates in the study's units, to four digits.
std::string note_text(const Study& study, const std::string& note);

}  // namespace equipoise
