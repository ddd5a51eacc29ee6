// equipoise basin: the share of starts that ends in each attractor; equipoise report: the page for one machine.
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/sensitivity.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/shown/machine_page.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

// Says before anything is computed that no balancer can help, if so.
void say_to_leave_out(const Study& study, bool quiet) {
  const std::string why = quiet ? "" : below_resonance_words(study);
  if (!why.empty()) say(leave_balancer_out, why);
}

// What a page shows.
struct WrittenPage {
  MachinePage content;
  std::vector<TriedChange> tried;
};

// Runs the ensemble, tries changes if `changes` and its verdict asks for them, and writes the page (.html). `study`
// must result from `source`.
WrittenPage write_machine_page(const StudySource& source, const Study& study, const BasinOptions& options, bool changes,
                               const std::string& path) {
  WrittenPage page{
      machine_page(study, given_machine(source.toml, source.name, source.overrides, options.stop), options), {}};
  if (changes) page.tried = changes_asked_for(page.content.basin, options);
  write_file(path, machine_html(page.content, page.tried));
  return page;
}

struct BasinArguments : CommonArguments {
  std::optional<std::string> start_index, half_width, decide, rows;
  std::string report;
  bool transients = false, no_transients = false, sensitivity = false, no_changes = false;
};

std::string transients_text(const Study& study, const TransientRow& row) {
  std::string text;
  for (const TransientFigure& column : transient_figures) {
    const bool asked = column.needs ? (study.limits.*column.needs).has_value()
                                    : column.value != &TransientRow::energy || !std::isnan(row.energy);
    if (asked) text += fmt::format("{} = {}\n", column.name, row.*column.value);
  }
  return text;
}

int print_replay(const Study& study, const BasinOptions& options, const std::string& given, ProgressLine& progress) {
  constexpr std::uint64_t largest = 999'999'999'999;
  const auto index =
      option_number<std::uint64_t>("--start-index", given, 0, largest, "a whole number from 0 to 999999999999");
  StartReplay replay;
  try {
    replay = replay_start(study, index, options);
  } catch (const RunError& e) {
    if (!stop_flag()) throw;
    progress.finish();
    say(e.what());
    return ended_early(progress.left(), nullptr, "");
  }
  progress.finish();
  const SamplingMethod method = study.sampling.method.value_or(SamplingMethod::random);
  std::string text =
      fmt::format("start {} of seed {}{}\n", index, study.sampling.seed,
                  method == SamplingMethod::random
                      ? std::string()
                      : fmt::format(", method {}", sampling_method_names[static_cast<std::size_t>(method)]));
  const InitialState& s = replay.start;
  for (std::size_t k = 0; k < replay.drawn.size(); ++k) {
    const UncertainValue& value = study.uncertain.values[k];
    text += fmt::format("{} = {}\n", value.key, value.text(replay.drawn[k]));
  }
  for (int i = 0; i < study.parameters.balls; ++i) text += fmt::format("phi_{} = {}\n", i + 1, s.phi[i]);
  if (!study.sampling.box.empty()) {
    text += fmt::format("x = {}\ny = {}\nx_dot = {}\ny_dot = {}\n", s.x, s.y, s.x_dot, s.y_dot);
    for (int i = 0; i < study.parameters.balls; ++i) text += fmt::format("phi_dot_{} = {}\n", i + 1, s.phi_dot[i]);
  }
  const auto by = static_cast<std::size_t>(replay.outcome.by);
  const std::string outcome =
      replay.outcome.kind == OutcomeKind::attracted ? replay.name : name_of(replay.outcome.kind);
  text += fmt::format("outcome = {}\ndecided_by = {}\ndecision_time = {}\n", outcome, decided_by_names[by],
                      replay.outcome.time);
  if (study.speed.driven()) text += fmt::format("mean_speed = {}\n", replay.outcome.mean_speed);
  if (replay.transients) text += transients_text(study, *replay.transients);
  put(text);
  return done;
}

int run_basin(const BasinArguments& a) {
  BasinOptions options;
  begin_computing(a, options);
  require_ending("--report", a.report, ".html");
  require_writable("--report", a.report);
  if (a.start_index && !a.report.empty())
    throw InputError("--report", "", display_text(a.report),
                     "a page reports an ensemble, not one start; must be left out with --start-index");
  StudySource source = source_of(a);
  if (a.decide) {
    option_choice<ClassificationMode>("--decide", *a.decide, classification_mode_names);
    source.overrides.push_back("numerics.decide=" + *a.decide);
  }
  const Study study = source.with();
  if (a.half_width) options.half_width = half_width_option(*a.half_width);
  if (a.half_width) require_writable("-o", a.output);  // a pilot may run before the file is opened
  options.limit_given = a.starts.has_value();
  if (a.no_transients)
    options.transients = false;
  else if (a.transients || study.physical)
    options.transients = true;
  options.output = a.output;
  if (!a.start_index && gathers_transients(study, options)) say_to_leave_out(study, a.quiet);
  ProgressLine progress(a.quiet, options);
  if (a.start_index) return print_replay(study, options, *a.start_index, progress);
  SensitivityOptions depends;
  if (a.sensitivity) {
    static_cast<RunOptions&>(depends) = options;
    if (a.rows)
      depends.rows =
          option_number<std::uint64_t>("--sensitivity", *a.rows, 2, 1'000'000, "a whole number from 2 to 1000000");
    check_sensitivity(study);
  }
  BasinResult result;
  std::vector<TriedChange> tried;
  if (a.report.empty()) {
    result = basin(study, options);
    if (!a.no_changes) tried = changes_asked_for(result, options);
  } else {
    WrittenPage page = write_machine_page(source, study, options, !a.no_changes, a.report);
    result = std::move(page.content.basin);
    tried = std::move(page.tried);
  }
  if (a.sensitivity && !result.partial) result.sensitivity = sensitivity(study, depends);
  progress.finish();
  put(a.json ? json_text(result, tried) : basin_text(result, text_style(), tried));
  const bool partial = result.partial || (result.sensitivity && result.sensitivity->partial);
  return partial && stop_flag() ? ended_early(progress.left(), kept_by_output, a.output) : done;
}

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

Command add_basin(CLI::App& app) {
  const auto a = std::make_shared<BasinArguments>();
  add_study(app, *a);
  add_starts(app, *a, "number of runs; with --half-width, the maximum");
  app.add_option("--half-width", a->half_width,
                 "keep sampling until every 95 % interval is narrower than +-H (e.g. 0.005 for +-0.5 %)")
      ->type_name("H");
  app.add_option_function<std::vector<std::string>>(
         "--sensitivity",
         [a](const std::vector<std::string>& given) {
           a->sensitivity = true;
           if (!given.empty() && !given.front().empty()) a->rows = given.front();
         },
         "for studies with uncertain values: which of them matters most (Sobol indices, N rows)")
      ->expected(0, 1)
      ->type_name("[N]");
  app.add_option("--start-index", a->start_index, "replay run I alone and print its starting angles and outcome")
      ->type_name("I");
  app.add_option("--decide", a->decide,
                 "how early outcomes are decided: validated (default), proof, horizon (never early)")
      ->type_name("HOW");
  app.add_option("-o,--output", a->output, "save every run here (NetCDF); rerun the command to resume or extend")
      ->type_name("FILE.nc");
  CLI::Option* asked =
      app.add_flag("--transients", a->transients,
                   "peak vibration, bearing force, settling time and the verdict (on by default if the "
                   "study has [limits] or [standards] or uses units)");
  app.add_flag("--no-transients", a->no_transients, "skip vibration figures and the verdict")->excludes(asked);
  app.add_option("--report", a->report, "also write the printable HTML report, with vibration figures")
      ->type_name("FILE.html");
  add_no_changes(app, a->no_changes);
  add_wide(app);
  add_details(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  add_json(app, a->json);
  return [a] { return run_basin(*a); };
}

Command add_report(CLI::App& app) {
  const auto a = std::make_shared<ReportArguments>();
  add_study(app, *a);
  app.add_option("-o,--output", a->output, "HTML report to write, in one file")->required()->type_name("FILE.html");
  add_starts(app, *a);
  add_no_changes(app, a->no_changes);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_report(*a); };
}

}  // namespace equipoise::app
