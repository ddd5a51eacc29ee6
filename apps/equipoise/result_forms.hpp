// What commands make of a result besides what they print: table, picture, page.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

namespace equipoise::app {

/// What the options ask for; empty: nothing.
struct ResultForms {
  std::string output, csv, plot, report;
  bool json = false;
};

/// What the options are said to do in a command's help; null: it has none such.
struct FormWords {
  const char* csv;
  const char* plot;
};
/// --csv, --plot, --report, --json.
void add_forms(CLI::App& app, ResultForms& forms, const FormWords& words);

/// Throws InputError for endings that the files must not have, for places that cannot be written, and if gnuplot is
/// missing.
void check_forms(const ResultForms& forms);

/// How a result is told in each of the forms.
struct FormMakers {
  std::function<std::string()> text, json, csv;
  std::function<std::string(const std::string& file)> plot;  ///< a script for gnuplot that draws into the file
  std::function<std::string()> html;
};
/// Prints, writes, draws.
void put_forms(const ResultForms& forms, const FormMakers& makers);

}  // namespace equipoise::app
