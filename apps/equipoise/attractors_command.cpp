// equipoise attractors: every steady motion of the final speed.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/result_files/branches_file.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct AttractorsArguments : CommonArguments {
  std::string along, plot;
  std::vector<std::string> states;
};

// "x,y,u,v,phi_1,..,phi_n,q_1,..,q_n", the form of --state.
std::vector<double> parse_state(const std::string& text, int balls) {
  std::vector<double> state;
  const std::size_t size = 4 + 2 * static_cast<std::size_t>(balls);
  const std::string allowed = fmt::format("{} numbers separated by commas: x,y,u,v, ball angles, ball rates", size);
  for (const std::string& part : parts_of(text, ','))
    state.push_back(option_number<double>("--state", part, -1e6, 1e6, allowed.c_str()));
  if (state.size() != size) throw InputError("--state", "", text, "must be " + allowed);
  return state;
}

std::vector<std::vector<double>> states_of(const AttractorsArguments& a, const Study& study) {
  std::vector<std::vector<double>> states;
  for (const std::string& text : a.states) states.push_back(parse_state(text, study.parameters.balls));
  return states;
}

// --along: attractors are continued along a parameter.
int follow_along(const AttractorsArguments& a) {
  ContinuationOptions options;
  begin_computing(a, options);
  const Study study = at_medians(source_of(a).with());
  options.starts = a.starts ? study.sampling.starts : 0;
  options.warm_start_states = states_of(a, study);
  require_ending("--output", a.output, ".csv", ".nc");
  require_ending("--plot", a.plot, ".svg");
  const ParameterLine line(study, a.along, "--along");
  require_writable("--output", a.output);
  require_writable("--plot", a.plot);
  ProgressLine progress(a.quiet, options);
  const BranchesResult result = follow_attractors(study, line, options);
  progress.finish();
  put(a.json ? json_text(result) : result_text(result, text_style()));
  if (a.output.ends_with(".csv")) write_file(a.output, branches_csv(result));
  if (a.output.ends_with(".nc")) write_branches_file(a.output, result);
  if (!a.plot.empty()) write_file(a.plot, result_svg(result, file_title(result.study)));
  return result.partial ? ended_early(progress.left(), nullptr, "") : done;
}

int run_attractors(const AttractorsArguments& a) {
  if (!a.along.empty()) return follow_along(a);
  AttractorsOptions options;
  begin_computing(a, options);
  for (const auto& [option, value] : {std::pair{"--output", &a.output}, std::pair{"--plot", &a.plot}})
    if (!value->empty()) throw InputError(option, "", *value, "goes with --along KEY=FROM:TO:STEP only");
  const Study study = at_medians(source_of(a).with());
  if (a.starts) options.starts = study.sampling.starts;
  options.warm_start_states = states_of(a, study);
  ProgressLine progress(a.quiet, options);
  const AttractorsResult result = attractors(study, options);
  progress.finish();
  put(a.json ? json_text(result) : result_text(result, text_style()));
  return result.basin.partial && stop_flag() ? ended_early(progress.left(), nullptr, "") : done;
}

}  // namespace

Command add_attractors(CLI::App& app) {
  const auto a = std::make_shared<AttractorsArguments>();
  add_study(app, *a);
  add_starts(app, *a, fmt::format("number of runs to search with (default {})", search_starts).c_str(),
             "seed of the random starts");
  app.add_option("--state", a->states,
                 "also start here, to reach attractors too rare to meet by chance: x,y,u,v, ball angles, ball "
                 "rates, as \"state\" in --json prints them; may be repeated")
      ->type_name("X,Y,...")
      ->take_all();
  app.add_option(
         "--along", a->along,
         "follow every attractor along a study key, e.g. speed.final=1.4:6.5:0.05, or with units "
         "\"speed.final=900 rpm:4000 rpm:50 rpm\"; with --starts: also search with that many runs at every value")
      ->type_name("KEY=FROM:TO:STEP");
  app.add_option("-o,--output", a->output,
                 "with --along: one line per value and attractor (.csv), or the same as NetCDF (.nc)")
      ->type_name("FILE");
  app.add_option("--plot", a->plot, "with --along: a picture of r_min to r_max")->type_name("FILE.svg");
  add_usual(app, *a);
  add_json(app, a->json);
  return [a] { return run_attractors(*a); };
}

}  // namespace equipoise::app
