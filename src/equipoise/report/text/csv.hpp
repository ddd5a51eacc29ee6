// CSV; and the parameters of sweeps and similar results as columns of tables, CSV and JSON.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/json.hpp"
#include "equipoise/results/commands/sweep_result.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise {

/// The shortest text that reads back to the same number; empty if it is not finite.
std::string csv_number(double value);
/// Quoted if necessary, with inner quotes doubled (RFC 4180); behind an apostrophe if a spreadsheet would take it for a
/// formula.
std::string csv_text(const std::string& given);
/// The study as comments, line by line.
std::string csv_study(const Study& study);

/// "unbalance, g mm": the title of a key's column.
std::string column_title(const std::string& key, const std::string& unit);
/// The columns of all parameters: titles in words, and values in a cell.
std::vector<std::string> parameter_titles(const std::vector<SweepAxis>& axes);
std::vector<DocumentCell> parameter_values(const std::vector<SweepAxis>& axes, std::size_t cell);

/// The same in CSV, each with a comma behind it.
std::string csv_titles(const std::vector<SweepAxis>& axes);
std::string csv_values(const std::vector<SweepAxis>& axes, std::size_t cell);
/// "rotor.unbalance (g mm)".
std::string csv_title(const std::string& key, const std::string& unit);

/// All parameters with their values; and the values in a cell, by key.
std::vector<SweepParameter> parameters_of(const std::vector<SweepAxis>& axes);
void to_json(Json& json, const SweepParameter& parameter);
void to_json(Json& json, const PartOf<std::size_t, std::vector<SweepAxis>>& cell);

}  // namespace equipoise
