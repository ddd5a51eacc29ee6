// A sweep for people and for machines.
#pragma once

#include <string>

#include "equipoise/results/sweep_result.hpp"

namespace equipoise {

/// A line a cell for the terminal.
std::string sweep_text(const SweepResult& result);

/// One JSON object. docs/guide/command-line.md lists the keys.
std::string sweep_json(const SweepResult& result);

/// A line a cell and outcome, the study before them as comments.
std::string sweep_csv(const SweepResult& result);

}  // namespace equipoise
