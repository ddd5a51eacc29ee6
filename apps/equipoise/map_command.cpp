// equipoise map: the outcome of a start at every pixel of a plane.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/report/plots/map_drawing.hpp"
#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/report/html/given_machine.hpp"
#include "equipoise/report/html/map_html.hpp"
#include "equipoise/report/reports/map_report.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "options.hpp"
#include "plane_axes.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "time_limit.hpp"
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct MapArguments : ResultForms, ComputingArguments, PlaneAxes {
  std::string study;
  std::vector<std::string> overrides, ties;
};

void put_map(const ResultForms& a, const BasinSlice& map, const std::function<GivenMachine()>& machine) {
  put_forms(a, {[&] { return map_text(map, text_style()); },
                [&] { return map_json(map); },
                {},
                [&] { return map_plot(map, file_title(map.study)); },
                [&] { return map_html(map, machine()); }});
}

int run_map(const MapArguments& a) {
  begin_computing(a);
  const std::string text = read_study_text(a.study), name = display_text(a.study);
  const Study study = at_medians(parse_study(text, name, a.overrides));
  check_has_balls(study);
  const ReadAxes axes = read_axes(study, a);
  BasinSliceSettings settings;
  settings.x = axes.x;
  settings.y = axes.y;
  for (const std::string& tie : a.ties) settings.links.push_back(angle_link(tie, "--tie"));
  check_forms(a);
  settings.output = a.output;
  settings.threads = threads_option(a.threads);
  settings.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  progress.listen(settings);
  const BasinSlice map = naming_axes(axes, "map", [&] { return basin_slice(study, settings); });
  progress.finish();
  if (map.read_whole) say(words::map_read, a.output);
  put_map(a, map, [&] { return given_machine(text, name, a.overrides); });
  return map.complete ? done : ended_early(progress.left(), kept_by_output, a.output);
}

}  // namespace

Command add_map(CLI::App& app) {
  const auto a = std::make_shared<MapArguments>();
  static_cast<PlaneAxes&>(*a) = {"initial.phi_1", "initial.phi_2", "", "", "512x512"};
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  add_plane_axes(app, *a, help::map::x, help::map::y, help::map::size);
  app.add_option("--tie", a->ties, help::map::tie)->type_name("PHI_I=PHI_J+ANGLE")->take_all();
  app.add_option("-o,--output", a->output, help::map::output)->type_name("FILE");
  add_forms(app, *a, {nullptr, help::map::plot});
  add_wide(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_map(*a); };
}

}  // namespace equipoise::app
