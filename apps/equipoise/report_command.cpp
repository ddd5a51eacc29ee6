// equipoise report: the page for one machine.
#include "report_command.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/decision/try_changes.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/html/given_machine.hpp"
#include "equipoise/report/html/machine_html.hpp"
#include "equipoise/report/decision/below_resonance.hpp"
#include "equipoise/report/words/text.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "streams.hpp"
#include "time_limit.hpp"
#include "help.hpp"

namespace equipoise::app {

WrittenPage write_machine_page(const StudySource& source, const Study& study, const BasinOptions& options, bool changes,
                               const std::string& path) {
  WrittenPage page{
      machine_page(study, given_machine(source.toml, source.name, source.overrides, options.stop), options), {}};
  if (changes) page.tried = changes_asked_for(page.content.basin, options);
  write_file(path, machine_html(page.content, page.tried));
  return page;
}

void say_to_leave_out(const Study& study, bool quiet) {
  const std::string why = quiet ? "" : below_resonance_words(study);
  if (!why.empty()) say(equipoise::words::text::leave_out, why);
}

namespace {

struct ReportArguments : CommonArguments {
  bool no_changes = false;
};

int run_report(const ReportArguments& a) {
  BasinOptions options;
  begin_computing(a, options);
  require_ending("--output", a.output, ".html");
  require_writable("--output", a.output);
  const StudySource source = source_of(a);
  const Study study = source.with();
  say_to_leave_out(study, a.quiet);
  ProgressLine progress(a.quiet, options);
  const WrittenPage page = write_machine_page(source, study, options, !a.no_changes, a.output);
  const BasinResult& result = page.content.basin;
  progress.finish();
  const auto verdict = verdict_of(result, page.tried);
  put((verdict ? verdict_text(*verdict, text_style()) : "") + answer_sentence(result) + "\n");
  return result.partial && stop_flag() ? ended_early(progress.left(), nullptr, "") : done;
}

}  // namespace

Command add_report(CLI::App& app) {
  const auto a = std::make_shared<ReportArguments>();
  add_study(app, *a);
  app.add_option("-o,--output", a->output, help::report_page::output)->required()->type_name("FILE.html");
  add_starts(app, *a);
  add_no_changes(app, a->no_changes);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_report(*a); };
}

}  // namespace equipoise::app
