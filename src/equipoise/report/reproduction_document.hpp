// The reproduced paper as a report.
#pragma once

#include "equipoise/report/document.hpp"
#include "equipoise/report/reproduction.hpp"

namespace equipoise {

/// Verdicts first, then the comparison of laws, every table, the figures, the open questions, and the settings behind
/// every number. Pictures are taken from r.pictures by their identifiers ("table-3", "figure-transients").
Document reproduction_document(const Reproduction& r);

}  // namespace equipoise
