// Designs as text and JSON.
#pragma once

#include <cstddef>
#include <string>

#include "equipoise/report/answers/design_words.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// For a terminal: the front, the chosen design beside the original study, its margins, what limits it.
std::string design_text(const DesignResult& result, const TextStyle& style = wide_style);
/// One JSON object; figures are in the units of "units", shares are fractions of one, infinite values are null.
std::string design_json(const DesignResult& result);
/// One line per member of the front.
std::string design_csv(const DesignResult& result);

}  // namespace equipoise
