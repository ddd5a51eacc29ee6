// Trees of values from TOML text, and back.
// This room: a text as a tree.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "equipoise/study/toml/study_value.hpp"

namespace equipoise::study {

/// Why a text cannot be read, and where; line and column (in bytes) count from 1.
struct TextFault {
  std::size_t line, column;
  std::string problem;
};

/// A study needs at most four parts. The parser and its trees recurse once per part on a limited stack.
inline constexpr int most_key_parts = 16;

/// Every value knows its line; members are sorted by key. Throws TextFault if the text is not TOML.
StudyValue parse_toml(std::string_view text);

/// The shortest text that reads back to the same number, always as a TOML float.
std::string number_text(double v);

/// A value as it stands behind "key = ": "2.0", "[1, 2]", "{ uniform = ["1 g", "2 g"] }".
std::string value_text(const StudyValue& value);
/// The same for a message: shortened, its strings as they are.
std::string shown(const StudyValue& value);

/// Text of a study's tables and arrays of tables, in the order of its members.
std::string toml_text(const StudyValue& tables);

}  // namespace equipoise::study
