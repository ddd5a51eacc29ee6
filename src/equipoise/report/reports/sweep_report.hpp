// A sweep as text, JSON and CSV.
#pragma once

#include <string>

#include "equipoise/report/text/table_text.hpp"
#include "equipoise/results/commands/sweep_result.hpp"

namespace equipoise {

/// The cells with the largest and the smallest share, then one line per cell, for the terminal.
std::string sweep_text(const SweepResult& result, const TextStyle& style = wide_style);

/// One JSON object. docs/reference/commands/sweep.md lists the keys.
std::string sweep_json(const SweepResult& result);

/// One line per cell and outcome, after the study as comments.
std::string sweep_csv(const SweepResult& result);

}  // namespace equipoise
