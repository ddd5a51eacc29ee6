// Each result as a document for the terminal and for a page, as one JSON object whose keys docs/reference/commands
// lists, and as CSV.
// This room: each result as a document, CSV and JSON.
#pragma once

#include <span>
#include <string>

#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/attractors_result.hpp"
#include "equipoise/results/commands/basin_slice.hpp"
#include "equipoise/results/commands/branch.hpp"
#include "equipoise/results/commands/capacity_result.hpp"
#include "equipoise/results/commands/comparison_result.hpp"
#include "equipoise/results/commands/design_result.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/results/result_files/inspection.hpp"

namespace equipoise {

/// Verdict, shares in percent, the rotor without balls next to that with them. `tried`: changes for the verdict to
/// report.
std::string basin_text(const BasinResult& result, const TextStyle& style = wide_style,
                       std::span<const TriedChange> tried = {});
/// The page for one machine: the same with drawings, the changes that were tried, the machine and the study in full.
std::string machine_html(const MachinePage& page, std::span<const TriedChange> tried = {});
std::string json_text(const BasinResult& result, std::span<const TriedChange> tried = {});

Document document_of(const AttractorsResult& result);
std::string json_text(const AttractorsResult& result);

/// CSV: one line per value and branch, after comment lines with the study and the version.
Document document_of(const BranchesResult& result);
std::string json_text(const BranchesResult& result);
std::string branches_csv(const BranchesResult& result);

/// The cells with the largest and the smallest share, then one line per cell. CSV: one line per cell and outcome.
Document document_of(const SweepResult& result);
std::string json_text(const SweepResult& result);
std::string sweep_csv(const SweepResult& result);

/// One line per cell, also for those that a stopped run left open.
Document document_of(const CapacityResult& result);
DocumentTable capacity_table(const CapacityResult& result);
std::string json_text(const CapacityResult& result);
std::string capacity_csv(const CapacityResult& result);

Document document_of(const BasinSlice& map);
std::string json_text(const BasinSlice& map);

/// Shares, differences, changes and a verdict, which is the difference in balanced starts in one sentence.
Document document_of(const ComparisonResult& result);
std::string json_text(const ComparisonResult& result);
std::string verdict(const ComparisonResult& result);

/// The front, the chosen design next to the original study, its margins, what limits it. JSON: figures are in the units
/// of "units", shares are fractions of one, infinite values are null. CSV: one line per member of the front.
Document document_of(const DesignResult& result);
std::string json_text(const DesignResult& result);
std::string design_csv(const DesignResult& result);

std::string inspection_text(const Inspection& inspection);
std::string json_text(const Inspection& inspection);

}  // namespace equipoise
