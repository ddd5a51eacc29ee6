// equipoise attractors: every steady motion of the final speed.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "along_command.hpp"
#include "commands.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/report/reports/attractors_report.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "streams.hpp"
#include "time_limit.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct AttractorsArguments : ComputingArguments {
  std::string study, along, output, plot;
  std::vector<std::string> overrides, states;
  std::optional<std::string> starts, seed;
  bool json = false;
};

// "x,y,u,v,phi_1,..,phi_n,q_1,..,q_n", the form of --state.
std::vector<double> parse_state(const std::string& text, int balls) {
  std::vector<double> state;
  const std::size_t size = 4 + 2 * static_cast<std::size_t>(balls);
  const std::string allowed = fmt::format(words::state_form, size);
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    state.push_back(option_number<double>("--state", text.substr(at, comma - at), -1e6, 1e6, allowed.c_str()));
    at = comma + 1;
  }
  if (state.size() != size) throw InputError("--state", "", text, "must be " + allowed);
  return state;
}

int follow_along(const AttractorsArguments& a) {
  std::vector<std::string> overrides = a.overrides;
  override_starts(a.starts, a.seed, overrides);
  const Study study = at_medians(read_study(a.study, overrides));
  AlongArguments along;
  along.along = a.along;
  along.output = a.output;
  along.plot = a.plot;
  along.starts = a.starts ? study.sampling.starts : 0;
  along.threads = threads_option(a.threads);
  for (const std::string& text : a.states) along.states.push_back(parse_state(text, study.parameters.balls));
  along.json = a.json;
  along.quiet = a.quiet;
  return run_along(study, along);
}

int run_attractors(const AttractorsArguments& a) {
  begin_computing(a);
  if (!a.along.empty()) return follow_along(a);
  for (const auto& [option, value] : {std::pair{"--output", &a.output}, std::pair{"--plot", &a.plot}})
    if (!value->empty()) throw InputError(option, "", *value, words::along_only);
  std::vector<std::string> overrides = a.overrides;
  override_starts(a.starts, a.seed, overrides);
  const Study study = at_medians(read_study(a.study, overrides));
  AttractorsOptions options;
  if (a.starts) options.starts = study.sampling.starts;
  options.threads = threads_option(a.threads);
  for (const std::string& text : a.states)
    options.warm_start_states.push_back(parse_state(text, study.parameters.balls));
  options.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  progress.listen(options);
  const AttractorsResult result = attractors(study, options);
  progress.finish();
  put(a.json ? attractors_json(result) : attractors_text(result, text_style()));
  return result.basin.partial && stop_flag() ? ended_early(progress.left(), nullptr, "") : done;
}

}  // namespace

Command add_attractors(CLI::App& app) {
  const auto a = std::make_shared<AttractorsArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_option("--starts", a->starts, fmt::format(help::attractors::starts, search_starts))->type_name("N");
  app.add_option("--seed", a->seed, help::attractors::seed)->type_name("S");
  app.add_option("--state", a->states, help::attractors::state)->type_name("X,Y,...")->take_all();
  app.add_option("--along", a->along, help::attractors::along)->type_name("KEY=FROM:TO:STEP");
  app.add_option("-o,--output", a->output, help::attractors::output)->type_name("FILE");
  app.add_option("--plot", a->plot, help::attractors::plot)->type_name("FILE.svg");
  add_wide(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  app.add_flag("--json", a->json, help::json);
  return [a] { return run_attractors(*a); };
}

}  // namespace equipoise::app
