// The names of a study's keys: which a table may hold, and which one a misspelling meant.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "equipoise/study/reading/table_reader.hpp"

namespace equipoise::study {

/// Few enough edits apart that one is a misspelling of the other.
bool nearly_same(std::string_view a, std::string_view b);

/// "unknown key; did you mean "stiffness"? (allowed: ...)". `table`: dotted name of the table that holds it, or empty;
/// `known`: the keys that the table may hold.
std::string unknown_key(std::string_view table, std::string_view key, const std::vector<std::string>& known);

/// Throws for the first unknown table.
void check_tables(const StudyFile& file);

/// Throws for the first key that no study of this kind and profile has in its table. This runs before reading, so that
/// a misspelt key is not reported as another one that is missing.
void check_keys(const StudyFile& file, bool physical);

}  // namespace equipoise::study
