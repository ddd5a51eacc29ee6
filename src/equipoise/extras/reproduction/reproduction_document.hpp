// The reproduced paper as a report.
#pragma once

#include <string>

#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/report/drawing/document.hpp"

namespace equipoise {

/// Each drawing stands below a heading whose anchor names it ("table-3", "figure-transients"). `explorer`: address of
/// the explorer's page, to which every row's study then links; may be empty.
Document reproduction_document(const Reproduction& r, const std::string& explorer = "");

}  // namespace equipoise
