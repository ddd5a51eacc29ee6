// Tables that reports for the terminal and pages share.
#pragma once

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/cell_text.hpp"
#include "equipoise/results/commands/capacity_result.hpp"
#include "equipoise/results/commands/design_result.hpp"

namespace equipoise {

/// A row a cell, those that a stopped run left open too.
DocumentTable capacity_table(const CapacityResult& result, KeyWords words);

/// Of a design that has a chosen candidate. Candidates that no other beats, the chosen one good; it beside the study as
/// it is; how far each of its numbers may be off.
DocumentTable front_table(const DesignResult& result, KeyWords words);
DocumentTable figure_table(const DesignResult& result);
DocumentTable margin_table(const DesignResult& result, KeyWords words);

}  // namespace equipoise
