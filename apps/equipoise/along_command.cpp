// Attractors along a parameter: files, picture, exit code.
#include "along_command.hpp"

#include "commands.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/report/plots/branch_plot.hpp"
#include "equipoise/report/reports/branches_report.hpp"
#include "equipoise/results/result_files/branches_file.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

int run_along(const Study& study, const AlongArguments& a) {
  require_ending("--output", a.output, ".csv", ".nc");
  require_ending("--plot", a.plot, ".svg");
  const ParameterLine line(study, a.along, "--along");
  require_writable("--output", a.output);
  require_writable("--plot", a.plot);

  ContinuationOptions options;
  options.threads = a.threads;
  options.starts = a.starts;
  options.warm_start_states = a.states;
  options.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  progress.listen(options);
  const BranchesResult result = follow_attractors(study, line, options);
  progress.finish();
  put(a.json ? branches_json(result) : branches_text(result, text_style()));
  if (a.output.ends_with(".csv")) write_file(a.output, branches_csv(result));
  if (a.output.ends_with(".nc")) write_branches_file(a.output, result);
  if (!a.plot.empty()) write_file(a.plot, branch_plot(result, file_title(result.study)));
  return result.partial ? ended_early(progress.left(), nullptr, "") : done;
}

}  // namespace equipoise::app
