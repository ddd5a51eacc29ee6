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

/// A further cell for each of `columns`, with a comma before it: its name, or its number of `of`.
template <class Columns>
std::string csv_names(const Columns& columns) {
  std::string line;
  for (const auto& c : columns) line += std::string(",") + c.name;
  return line;
}
template <class Columns, class Of>
std::string csv_numbers(const Columns& columns, const Of& of) {
  std::string line;
  for (const auto& c : columns)
    if constexpr (requires { c.value(of).value_or(0.0); })
      line += "," + csv_number(c.value(of).value_or(no_number));
    else
      line += "," + csv_number(c.value(of));
  return line;
}

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
