// equipoise map: the outcome of a start at every pixel of a plane.
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.hpp"
#include "equipoise/plots/map_plot.hpp"
#include "equipoise/basin_slices/slice_axis.hpp"
#include "equipoise/basin_slices/basin_slice.hpp"
#include "equipoise/html/given_machine.hpp"
#include "equipoise/html/map_html.hpp"
#include "equipoise/reports/map_report.hpp"
#include "equipoise/start_runs/checks.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct MapArguments : ResultForms, ComputingArguments {
  std::string study, x = "initial.phi_1", y = "initial.phi_2", x_range, y_range, size = "512x512", from;
  std::vector<std::string> overrides, ties;
  std::optional<std::string> refine;
};

int block_option(const std::string& text) {
  constexpr const char* allowed = "a power of two from 2 to 64";
  const int block = option_number<int>("--refine", text, 2, largest_map_block, allowed);
  if ((block & (block - 1)) != 0) throw InputError("--refine", "", text, fmt::format("must be {}", allowed));
  return block;
}

void put_map(const ResultForms& a, const BasinSlice& map, const std::function<GivenMachine()>& machine) {
  put_forms(a, {[&] { return map_text(map, text_style()); },
                [&] { return map_json(map); },
                {},
                [&](const std::string& file) {
                  return map_plot_script(map, display_text(std::filesystem::path(map.study.name).filename().string()),
                                         file, map.block > 0 ? SliceShading::none : SliceShading::decision_time);
                },
                [&] { return map_html(map, machine()); }});
}

int run_map(const MapArguments& a) {
  begin_computing(a);
  const std::string text = read_study_text(a.study), name = display_text(a.study);
  const Study study = at_medians(parse_study(text, name, a.overrides));
  check_has_balls(study);
  const SliceSize size = map_size(a.size, "--size");
  BasinSliceSettings settings;
  settings.x = slice_axis(study, a.x, a.x_range, size.width, "--x-range");
  settings.y = slice_axis(study, a.y, a.y_range, size.height, "--y-range");
  for (const std::string& tie : a.ties) settings.links.push_back(angle_link(tie, "--tie"));
  if (a.refine) settings.block = block_option(*a.refine);
  require_ending("--from", a.from, ".nc");
  check_forms(a);
  settings.output = a.output;
  settings.from = a.from;
  settings.threads = threads_option(a.threads);
  settings.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  settings.progress = progress.listener();
  const BasinSlice map = basin_slice(study, settings);
  progress.finish();
  if (map.read_whole) say("read from {}", a.output);
  put_map(a, map, [&] { return given_machine(text, name, a.overrides); });
  return map.complete ? done : ended_early(progress.left(), kept_by_output, a.output);
}

}  // namespace

Command add_map(CLI::App& app) {
  const auto a = std::make_shared<MapArguments>();
  app.add_option("study", a->study, "study file (TOML)")->required()->type_name("STUDY");
  app.add_option(
         "--x", a->x,
         "what varies from left to right: a key of rotor, balancer, speed, release or initial that takes a number "
         "(default initial.phi_1)")
      ->type_name("KEY");
  app.add_option("--y", a->y, "the same from bottom to top (default initial.phi_2)")->type_name("KEY");
  app.add_option("--x-range", a->x_range,
                 "range, e.g. 1.5:6, -pi/2:pi/2, \"900 rpm:4000 rpm\" (default for ball angles: a whole turn)")
      ->type_name("LOW:HIGH");
  app.add_option("--y-range", a->y_range, "the same for --y")->type_name("LOW:HIGH");
  app.add_option("--size", a->size, "pixels (default 512x512)")->type_name("WIDTHxHEIGHT");
  app.add_option("--tie", a->ties, "a ball angle that follows another, e.g. phi_2=phi_1+pi; may be repeated")
      ->type_name("PHI_I=PHI_J+ANGLE")
      ->take_all();
  app.add_option(
         "--refine", a->refine,
         "compute the edges of blocks of N pixels first, fill in what lies within edges of one outcome, and divide "
         "the others (a power of two from 2 to 64; default: compute every pixel)")
      ->type_name("N");
  app.add_option(
         "-o,--output", a->output,
         "every pixel's outcome and time as NetCDF (.nc), kept as they come; the same command resumes, and reads "
         "what is there")
      ->type_name("FILE");
  app.add_option("--from", a->from, "take pixels with the same centres from another map's file")->type_name("FILE");
  add_forms(app, *a, {nullptr, "a picture (.png or .svg), darker where decided later; drawn by gnuplot"});
  add_text_style(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_map(*a); };
}

}  // namespace equipoise::app
