// Trees of values from TOML text, and back.
// This room: a text as a tree.
#pragma once

#include <string>
#include <string_view>

#include "equipoise/study/toml/study_value.hpp"

namespace equipoise::study {

/// Every value knows its line; members are sorted by key. Throws TextFault (text_guard.hpp) if the text is not TOML.
StudyValue parse_toml(std::string_view text);

/// The shortest text that reads back to the same number, always as a TOML float.
std::string number_text(double v);

/// A value as it stands behind "key = ": "2.0", "[1, 2]", "{ uniform = ["1 g", "2 g"] }".
std::string value_text(const StudyValue& value);

/// Text of a study's tables and arrays of tables, in the order of its members.
std::string toml_text(const StudyValue& tables);

}  // namespace equipoise::study
