// equipoise stability: where balance is stable in a plane of two parameters.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/basin_slices/slice_axis.hpp"
#include "equipoise/charts/stability_plot.hpp"
#include "equipoise/charts/stability_report.hpp"
#include "equipoise/stability/over_plane.hpp"
#include "help.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct StabilityArguments : ResultForms, ComputingArguments {
  std::string study, x = "speed.final", y = "balancer.drag", x_range, y_range, size = "512x512";
  std::vector<std::string> overrides;
};

int run_stability(const StabilityArguments& a) {
  begin_computing(a);
  const Study study = at_medians(read_study(a.study, a.overrides));
  const SliceSize size = map_size(a.size, "--size");
  StabilitySettings settings;
  settings.x = slice_axis(study, a.x, a.x_range, size.width, "--x-range");
  settings.y = slice_axis(study, a.y, a.y_range, size.height, "--y-range");
  check_forms(a);
  settings.output = a.output;
  settings.threads = threads_option(a.threads);
  settings.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  settings.progress = progress.listener();
  const StabilityPlane plane = stability(study, settings);
  progress.finish();
  put_forms(a, {[&] { return stability_text(plane, text_style()); },
                [&] { return stability_json(plane); },
                [&] { return stability_csv(plane); },
                [&](const std::string& file) {
                  return stability_plot_script(
                      plane, display_text(std::filesystem::path(plane.study.name).filename().string()), file);
                },
                {}});
  return plane.complete ? done : ended_early(progress.left(), nullptr, "");
}

}  // namespace

Command add_stability(CLI::App& app) {
  const auto a = std::make_shared<StabilityArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_option("--x", a->x, help::stability::x)->type_name("KEY");
  app.add_option("--y", a->y, help::stability::y)->type_name("KEY");
  app.add_option("--x-range", a->x_range, help::stability::x_range)->type_name("LOW:HIGH");
  app.add_option("--y-range", a->y_range, help::stability::y_range)->type_name("LOW:HIGH");
  app.add_option("--size", a->size, help::stability::size)->type_name("WIDTHxHEIGHT");
  app.add_option("-o,--output", a->output, help::stability::output)->type_name("FILE");
  app.add_option("--csv", a->csv, help::stability::csv)->type_name("FILE");
  app.add_option("--plot", a->plot, help::stability::plot)->type_name("FILE");
  app.add_flag("--json", a->json, help::json);
  add_text_style(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_stability(*a); };
}

}  // namespace equipoise::app
