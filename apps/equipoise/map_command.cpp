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
#include "help.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct MapArguments : ResultForms, ComputingArguments {
  std::string study, x = "initial.phi_1", y = "initial.phi_2", x_range, y_range, size = "512x512", from;
  std::vector<std::string> overrides, ties;
  std::optional<std::string> refine;
};

int block_option(const std::string& text) {
  const int block = option_number<int>("--refine", text, 2, largest_map_block, words::block_range);
  if ((block & (block - 1)) != 0)
    throw InputError("--refine", "", text, fmt::format(words::must_be, words::block_range));
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
  if (map.read_whole) say(words::map_read, a.output);
  put_map(a, map, [&] { return given_machine(text, name, a.overrides); });
  return map.complete ? done : ended_early(progress.left(), kept_by_output, a.output);
}

}  // namespace

Command add_map(CLI::App& app) {
  const auto a = std::make_shared<MapArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_option("--x", a->x, help::map::x)->type_name("KEY");
  app.add_option("--y", a->y, help::map::y)->type_name("KEY");
  app.add_option("--x-range", a->x_range, help::map::x_range)->type_name("LOW:HIGH");
  app.add_option("--y-range", a->y_range, help::map::y_range)->type_name("LOW:HIGH");
  app.add_option("--size", a->size, help::map::size)->type_name("WIDTHxHEIGHT");
  app.add_option("--tie", a->ties, help::map::tie)->type_name("PHI_I=PHI_J+ANGLE")->take_all();
  app.add_option("--refine", a->refine, help::map::refine)->type_name("N");
  app.add_option("-o,--output", a->output, help::map::output)->type_name("FILE");
  app.add_option("--from", a->from, help::map::from)->type_name("FILE");
  add_forms(app, *a, {nullptr, help::map::plot});
  add_text_style(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_map(*a); };
}

}  // namespace equipoise::app
