// equipoise design: the best balancer or spin-up within stated bounds.
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/analyses/design/design.hpp"
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

struct DesignArguments : ResultForms {
  std::string best;
  std::optional<std::string> trajectories;
};

StudySource design_source(const DesignArguments& a) {
  StudySource source = source_of(a);
  if (a.trajectories) {
    const auto n = option_number<std::uint64_t>("--trajectories", *a.trajectories, 1000, 1'000'000'000'000,
                                                "a whole number from 1000 to 1000000000000");
    source.overrides.push_back(fmt::format("design.trajectories={}", n));
  }
  return source;
}

int run_design(const DesignArguments& a) {
  begin_computing(a);
  Team team;
  StudySource source;
  DesignOptions options;
  options.output = a.output;
  options.stop = &stop_flag();
  const auto problem = team.prepared([&] {
    source = design_source(a);
    DesignProblem made(source);
    if (team.leads()) check_forms(a);
    require_ending("--best", a.best, ".toml");
    if (team.leads()) require_writable("--best", a.best);
    options.threads = team.threads(a.threads);
    return made;
  });
  if (!problem) return bad_input;
  if (!team.leads()) return team.follow(design_survey(*problem, options), options.threads, options.stop);
  options.search_time_over = half_of_the_time();
  ProgressLine progress(a.quiet, options);
  const DesignResult result = team.lead(options, [&] { return design(*problem, options); });
  progress.finish();
  put_forms(a, {result.study, [&] { return document_of(result); }, [&] { return json_text(result); },
                [&] { return design_csv(result); },
                [&] { return given_machine(source.toml, source.name, source.overrides); }});
  if (!a.best.empty() && result.chosen) write_file(a.best, result.best_study);
  std::optional<WorkLeft> left = progress.left();
  if (!left && result.resumed == 0 && result.trajectories > 0) {
    left = WorkLeft{result.trajectories, std::max(result.budget, result.trajectories), "trajectories"};
    left->seconds = result.seconds * (static_cast<double>(left->total) / static_cast<double>(left->done) - 1.0);
  }
  if (result.partial) return ended_early(left, kept_by_output, a.output);
  return result.feasible ? done : check_failed;
}

}  // namespace

Command add_design(CLI::App& app) {
  const auto a = std::make_shared<DesignArguments>();
  add_study(app, *a, "study file (TOML); without [design], a standard one is proposed and used");
  app.add_option("--best", a->best, "save the chosen design as a study file")->type_name("FILE.toml");
  app.add_option("--trajectories", a->trajectories,
                 "budget (default: design.trajectories, else 2000000; a proposed [design] states its own)")
      ->type_name("N");
  app.add_option("--seed", a->seed, "seed of the random starts, the same for all candidates")->type_name("S");
  app.add_option("-o,--output", a->output,
                 "all ensembles as NetCDF (.nc), saved as they finish; rerun the command to resume")
      ->type_name("FILE");
  add_forms(app, *a, {"one line per member of the front (.csv)", "a picture"});
  add_usual(app, *a);
  return [a] { return run_design(*a); };
}

}  // namespace equipoise::app
