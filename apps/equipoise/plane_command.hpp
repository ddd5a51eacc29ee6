// What the commands about a plane of two parameters, stability and chart, share.
#pragma once

#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "help.hpp"
#include "options.hpp"
#include "plane_axes.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

struct PlaneArguments : ResultForms, ComputingArguments, PlaneAxes {
  std::string study;
  std::vector<std::string> overrides;
};

/// What a command's help says about the files.
struct PlaneWords {
  const char* output;
  const char* csv;
  const char* plot;
};
/// -o, --csv, --plot, --json and what every computing command has.
inline void add_plane_forms(CLI::App& app, PlaneArguments& a, const PlaneWords& words) {
  app.add_option("-o,--output", a.output, words.output)->type_name("FILE");
  app.add_option("--csv", a.csv, words.csv)->type_name("FILE");
  app.add_option("--plot", a.plot, words.plot)->type_name("FILE.svg");
  app.add_flag("--json", a.json, help::json);
  add_wide(app);
  add_overrides(app, a.overrides);
  add_computing(app, a);
}

/// Reads the study, computes and puts out. `set(settings)` sets what the command has besides axes;
/// `compute(study, settings)` gives the result, which knows its study and whether it is complete; `forms(result)`
/// makes its FormMakers, which may refer to it.
template <class Settings, class Set, class Compute, class Forms>
int run_plane(const PlaneArguments& a, Settings settings, Set set, Compute compute, Forms forms) {
  begin_computing(a);
  const Study study = at_medians(read_study(a.study, a.overrides));
  const ReadAxes axes = read_axes(study, a);
  settings.x = axes.x;
  settings.y = axes.y;
  set(settings);
  check_forms(a);
  settings.output = a.output;
  settings.threads = threads_option(a.threads);
  settings.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  progress.listen(settings);
  const auto result = naming_axes(axes, "stability", [&] { return compute(study, settings); });
  progress.finish();
  put_forms(a, forms(result));
  return result.complete ? done : ended_early(progress.left(), nullptr, "");
}

}  // namespace equipoise::app
