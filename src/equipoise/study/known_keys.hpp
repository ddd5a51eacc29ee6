// The names of a study's keys: which a table may hold, and which was meant by one that it may not.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "equipoise/study/table_reader.hpp"

namespace equipoise::study {

/// Few enough edits that one is a misspelling of the other.
bool nearly_same(std::string_view a, std::string_view b);

/// "unknown key; did you mean "stiffness"? (allowed: ...)". `table` is the dotted name of the table that holds it, or
/// empty; `known` are the keys that this may hold.
std::string unknown_key(std::string_view table, std::string_view key, const std::vector<std::string>& known);

/// Throws for the first table that no study has.
void check_tables(const Document& document);

/// Throws for the first key that no study of this kind and profile has in its table: before anything is read, so that a
/// misspelt key is not reported as another one that is missing.
void check_keys(const Document& document, bool physical);

}  // namespace equipoise::study
