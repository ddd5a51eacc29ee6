// Notes of results, for the reader of a study.
#pragma once

#include <string>

#include "equipoise/results/types/note.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// A note with its speed and its growth rates in the study's
/// units, to four digits.
std::string note_text(const Study& study, const Note& note);

}  // namespace equipoise
