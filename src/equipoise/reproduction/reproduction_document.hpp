// The reproduced paper as a report.
#pragma once

#include <string>

#include "equipoise/drawing/document.hpp"
#include "equipoise/reproduction/reproduction.hpp"

namespace equipoise {

/// Verdicts first, then the comparison of laws, every table, the figures, the open questions, and the settings behind
/// every number. Pictures are taken from r.pictures by their identifiers ("table-3", "figure-transients"). `explorer`:
/// where the explorer's page lies, as seen from the report; every row's study then leads there. May be empty.
Document reproduction_document(const Reproduction& r, const std::string& explorer = "");

}  // namespace equipoise
