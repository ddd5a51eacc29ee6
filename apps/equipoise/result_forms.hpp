// What commands make of a result in addition to printing it: table, picture, page.
#pragma once

#include <functional>
#include <string>

#include <CLI/CLI.hpp>

#include "equipoise/report/drawing/document.hpp"
#include "equipoise/results/commands/machine_page.hpp"
#include "options.hpp"

namespace equipoise::app {

/// The files to write in addition to the output; empty: none.
struct ResultForms : CommonArguments {
  std::string csv, plot, report;
};

/// What a command's help says about these options; null: the command lacks the option.
struct FormWords {
  const char* csv;
  const char* plot;
  bool page = true;  ///< whether the command has --report
};
/// --csv, --plot, --report, --json.
void add_forms(CLI::App& app, ResultForms& forms, const FormWords& words);

/// Throws InputError for wrong file endings, and for places that cannot be written.
void check_forms(const ResultForms& forms);

/// The name of the study's file: the title of its pictures.
std::string file_title(const Study& study);

/// How to make the forms of a result: its document, which is text, picture and page, the latter with the machine; and
/// its numbers.
struct FormMakers {
  const Study& study;
  std::function<Document()> document;
  std::function<std::string()> json, csv;
  std::function<GivenMachine()> machine;
};
/// Prints and writes.
void put_forms(const ResultForms& forms, const FormMakers& makers);

}  // namespace equipoise::app
