// Trees of values from TOML text and back.
#pragma once

#include <string>
#include <string_view>

#include "equipoise/toml/study_value.hpp"

namespace equipoise::study {

/// Every value knows its line; a table's members stand in the order of their keys. Throws TextFault (text_guard.hpp)
/// for what is not TOML.
StudyValue parse_toml(std::string_view text);

/// Shortest text that reads back to the same number, always as a TOML float.
std::string number_text(double v);

/// A table of tables of a study, in the order of its members; keys are written as they are.
std::string toml_text(const StudyValue& tables);

}  // namespace equipoise::study
