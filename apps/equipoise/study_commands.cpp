// The quick commands: new, check, explain and inspect.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.hpp"
#include "equipoise/analyses/one_study/basin_cost.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/running/deadline.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/new_studies.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/result_files/inspection.hpp"
#include "options.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

int run_check(const CommonArguments& a) {
  begin_time(a.within);
  const StudySource source = source_of(a);
  const StudyCheck check = check_study(source.toml, source.name, source.overrides, &stop_flag());
  if (const SweepSetting sweep = source.with().sweep; !sweep.over.empty()) {
    const std::string where = own_sweep(source.name);
    SweepPlan(source, sweep_axes(sweep.over, sweep.zip, where), {}, where).check_cells(&stop_flag());
  }
  put(lines_filled(check.text(), text_style()));
  return stop_flag() ? ended_early({}, nullptr, "") : done;
}

struct ExplainArguments : CommonArguments {
  bool cost = false;
};

int run_explain(const ExplainArguments& a) {
  const Study study = read_study(a.study, a.overrides);
  Explanation e = explain(at_medians(study), &stop_flag());
  if (a.cost) {
    RunOptions options;
    options.stop = &stop_flag();
    e.cost = measure_cost(study, options, a.within ? read_time_limit("--within", *a.within) : cost_patience);
  } else if (a.within) {
    throw InputError("--within", "", display_text(*a.within), "goes with --cost only: nothing else takes time here");
  }
  put(a.json ? json_text(e) : explain_text(e, text_style()));
  return stop_flag() ? interrupted : done;
}

struct NewArguments {
  std::string machine;
  std::optional<std::string> output;
};

int run_new(const NewArguments& a) {
  const std::string text = new_study(a.machine, "MACHINE");
  if (!a.output) {
    put(text);
    return done;
  }
  std::error_code ignored;
  if (std::filesystem::exists(*a.output, ignored))
    throw InputError("-o", "", display_text(*a.output), "exists; must be a new file: no study is overwritten");
  require_writable("-o", *a.output);
  write_file(*a.output, text);
  say("{} is a study of a {} to start from; equipoise check {} says what is understood", display_text(*a.output),
      a.machine == "blank" ? "machine" : a.machine, display_text(*a.output));
  return done;
}

}  // namespace

Command add_check(CLI::App& app) {
  const auto a = std::make_shared<CommonArguments>();
  add_study(app, *a);
  add_wide(app);
  add_overrides(app, a->overrides);
  add_within(app, a->within);
  return [a] { return run_check(*a); };
}

Command add_explain(CLI::App& app) {
  const auto a = std::make_shared<ExplainArguments>();
  add_study(app, *a);
  app.add_flag("--cost", a->cost,
               "also estimate how long basin takes, from its search for attractors and its first runs");
  app.add_option("--within", a->within, "with --cost: the longest that the estimate may take (default 10s)")
      ->type_name("TIME");
  add_wide(app);
  add_overrides(app, a->overrides);
  add_json(app, a->json);
  return [a] { return run_explain(*a); };
}

Command add_new(CLI::App& app) {
  const auto a = std::make_shared<NewArguments>();
  app.add_option("machine", a->machine, fmt::format("one of: {}", fmt::join(new_machines(), ", ")))
      ->required()
      ->type_name("MACHINE");
  app.add_option("-o,--output", a->output, "write it to this new file instead of to standard output")
      ->type_name("FILE.toml");
  return [a] { return run_new(*a); };
}

Command add_inspect(CLI::App& app) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  const auto a = std::make_shared<Arguments>();
  app.add_option("file", a->file, "result file (.nc), or its unfinished part (.nc.part)")
      ->required()
      ->type_name("FILE");
  add_json(app, a->json);
  return [a]() -> int {
    const Inspection inspection = inspect_file(a->file);
    put(a->json ? json_text(inspection) : inspection_text(inspection));
    return inspection.damage.empty() ? done : check_failed;
  };
}

}  // namespace equipoise::app
