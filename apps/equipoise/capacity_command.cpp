// equipoise capacity: the largest unbalance, or other parameter, at which a stated share of starts balances.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/analyses/sweeps/capacity.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "team.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct CapacityArguments : ResultForms {
  std::string of, between, by = "balanced";
  std::vector<std::string> over;
  std::optional<std::string> at_least, precision;
  bool zip = false;
};

std::vector<SweepAxis> capacity_axes(const CapacityArguments& a) {
  return a.over.empty() ? std::vector<SweepAxis>{} : sweep_axes(a.over, a.zip, "--over");
}

StudySource capacity_source(const CapacityArguments& a) {
  const StudySource source = source_of(a);
  return a.of.empty() ? with_unbalance(source, capacity_axes(a)) : source;
}

SweepPlan capacity_plan(const CapacityArguments& a, const StudySource& source) {
  BasinOptions request;
  request.transients = a.by != "balanced";
  return SweepPlan(source, capacity_axes(a), request, "--over");
}

CapacityOptions capacity_options(const CapacityArguments& a, const SweepPlan& plan, const Team& team) {
  CapacityOptions options;
  options.of = "--of";
  options.key = capacity_key(plan.source(), a.of, options.of);
  static_cast<CapacityRange&>(options) = capacity_range(plan, options.key, a.between, "--between", &stop_flag());
  const std::vector<std::string> goals = capacity_goals(plan.study());
  option_choice<int>("--by", a.by, goals);
  options.by = a.by;
  if (a.at_least)
    options.at_least =
        option_number<double>("--at-least", *a.at_least, 0.01, 0.9999, "a fraction of one from 0.01 to 0.9999");
  if (a.precision)
    options.precision =
        option_number<double>("--precision", *a.precision, 1e-4, 0.1, "a part of the range from 0.0001 to 0.1");
  options.output = a.output;
  options.threads = team.threads(a.threads);
  options.stop = &stop_flag();
  return options;
}

int run_capacity(CapacityArguments& a) {
  begin_computing(a);
  // Many ensembles are run: enough starts to determine a share of 95 % to half a percent.
  if (!a.starts) a.starts = "10000";
  Team team;
  StudySource source;
  CapacityOptions options;
  const auto plan = team.prepared([&] {
    source = capacity_source(a);
    SweepPlan made = capacity_plan(a, source);
    options = capacity_options(a, made, team);
    if (team.leads()) check_forms(a);
    return made;
  });
  if (!plan) return bad_input;
  if (!team.leads()) return team.follow(capacity_survey(*plan, options), options.threads, options.stop);
  ProgressLine progress(a.quiet, options);
  const CapacityResult result = team.lead(options, [&] { return capacity(*plan, options); });
  progress.finish();
  put_forms(a, {result.study, [&] { return document_of(result); }, [&] { return json_text(result); },
                [&] { return capacity_csv(result); },
                [&] { return given_machine(source.toml, source.name, source.overrides); }});
  if (result.complete()) return done;
  WorkLeft left{result.resumed_trials + result.trials, result.most_trials, "trials (at most)"};
  if (result.trials > 0)
    left.seconds = result.seconds / static_cast<double>(result.trials) * static_cast<double>(left.total - left.done);
  return ended_early(left, kept_by_output, a.output);
}

}  // namespace

Command add_capacity(CLI::App& app) {
  const auto a = std::make_shared<CapacityArguments>();
  add_study(app, *a);
  app.add_option(
         "--of", a->of,
         "the parameter to maximise, any key that --set takes (default: the unbalance, in g mm if the study has "
         "physical units, otherwise rotor.eccentricity)")
      ->type_name("KEY");
  app.add_option("--between", a->between,
                 "range to search, e.g. 0.001:0.1 or \"20 g mm:400 g mm\" (default for an unbalance: up to what all "
                 "balls together can cancel)")
      ->type_name("LOW:HIGH");
  app.add_option(
         "--by", a->by,
         "what a run must do: balanced (default), limits (stay within all of [limits]), or one limit by its name")
      ->type_name("WHAT");
  app.add_option("--at-least", a->at_least, "fraction of runs that must do it (default 0.95)")->type_name("SHARE");
  app.add_option("--precision", a->precision, "how closely to locate it, as a fraction of the range (default 0.005)")
      ->type_name("P");
  app.add_option("--over", a->over, "a parameter and its values, as for equipoise sweep; up to three times")
      ->type_name("KEY=VALUES")
      ->take_all();
  add_zip(app, a->zip);
  add_starts(app, *a, "number of runs per ensemble (default 10000)",
             "seed of the random starts, the same in all ensembles");
  app.add_option("-o,--output", a->output,
                 "all cells as NetCDF (.nc), saved as they finish; rerun the command to resume")
      ->type_name("FILE");
  add_forms(app, *a, {"one line per cell (.csv)", "a picture"});
  add_usual(app, *a);
  return [a] { return run_capacity(*a); };
}

}  // namespace equipoise::app
