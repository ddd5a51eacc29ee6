// A study explained, as text and as JSON.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/explanation.hpp"

namespace equipoise {

/// Whether the balls can balance the rotor, in one line.
std::string verdict_text(const Explanation& e);

/// Text; in physical units wherever the study has scales.
std::string explain_text(const Explanation& e, const TextStyle& style = wide_style);

/// JSON.
std::string explain_json(const Explanation& e);

}  // namespace equipoise
