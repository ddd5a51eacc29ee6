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

struct ReportArguments : ComputingArguments {
  std::string study, output;
  std::vector<std::string> overrides;
  std::optional<std::string> starts, seed;
  bool no_changes = false;
};

int run_report(const ReportArguments& a) {
  begin_computing(a);
  require_ending("--output", a.output, ".html");
  require_writable("--output", a.output);
  std::vector<std::string> overrides = a.overrides;
  override_starts(a.starts, a.seed, overrides);
  BasinOptions options;
  options.threads = threads_option(a.threads);
  options.stop = &stop_flag();
  const std::string text = read_study_text(a.study), name = display_text(a.study);
  const Study study = parse_study(text, name, overrides);
  say_to_leave_out(study, a.quiet);
  ProgressLine progress(a.quiet);
  progress.listen(options);
  const WrittenPage page = write_machine_page({text, name, overrides}, study, options, !a.no_changes, a.output);
  const BasinResult& result = page.content.basin;
  progress.finish();
  const auto verdict = verdict_of(result, page.tried);
  put((verdict ? verdict_text(*verdict, text_style()) : "") + answer_sentence(result) + "\n");
  return result.partial && stop_flag() ? ended_early(progress.left(), nullptr, "") : done;
}

}  // namespace

Command add_report(CLI::App& app) {
  const auto a = std::make_shared<ReportArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_option("-o,--output", a->output, help::report_page::output)->required()->type_name("FILE.html");
  app.add_option("--starts", a->starts, help::starts)->type_name("N");
  app.add_option("--seed", a->seed, help::seed)->type_name("S");
  add_no_changes(app, a->no_changes);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_report(*a); };
}

}  // namespace equipoise::app
