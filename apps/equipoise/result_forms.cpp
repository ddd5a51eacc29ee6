// Checks the forms before any work, and makes them after it.
#include "result_forms.hpp"

#include <filesystem>
#include <utility>

#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "options.hpp"
#include "streams.hpp"

namespace equipoise::app {

void add_forms(CLI::App& app, ResultForms& forms, const FormWords& words) {
  if (words.csv) app.add_option("--csv", forms.csv, words.csv)->type_name("FILE");
  app.add_option("--plot", forms.plot, words.plot)->type_name("FILE.svg");
  if (words.page)
    app.add_option("--report", forms.report, "also write a printable HTML report, in one file")->type_name("FILE.html");
  add_json(app, forms.json);
}

std::string file_title(const Study& study) {
  return display_text(std::filesystem::path(study.name).filename().string());
}

void check_forms(const ResultForms& forms) {
  require_ending("--output", forms.output, ".nc");
  require_ending("--csv", forms.csv, ".csv");
  require_ending("--plot", forms.plot, ".svg");
  require_ending("--report", forms.report, ".html");
  for (const auto& [option, path] :
       {std::pair{"--output", forms.output}, {"--csv", forms.csv}, {"--plot", forms.plot}, {"--report", forms.report}})
    require_writable(option, path);
}

void put_forms(const ResultForms& forms, const FormMakers& makers) {
  const bool needed = !forms.json || !forms.plot.empty() || !forms.report.empty();
  const Document document = needed ? makers.document() : Document();
  put(forms.json ? makers.json() : document_text(document, text_style()));
  if (!forms.csv.empty()) write_file(forms.csv, makers.csv());
  if (!forms.plot.empty()) write_file(forms.plot, document_svg(document, file_title(makers.study)));
  if (!forms.report.empty()) write_file(forms.report, document_page(document, makers.study, makers.machine()));
}

}  // namespace equipoise::app
