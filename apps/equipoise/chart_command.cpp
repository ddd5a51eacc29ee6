// equipoise chart: curves in a plane of two parameters on which balance changes.
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/basin_slices/slice_axis.hpp"
#include "equipoise/charts/chart_plot.hpp"
#include "equipoise/charts/chart_report.hpp"
#include "equipoise/curves/bifurcation_chart.hpp"
#include "equipoise/words/chart.hpp"
#include "help.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

struct ChartArguments : ResultForms, ComputingArguments {
  std::string study, x, y, size = "64x64";
  std::uint64_t boxes = ChartSettings().boxes;
  double undecided = 1.0;
  std::vector<std::string> overrides;
};

SliceAxis chart_axis(const Study& study, const std::string& text, int points, const std::string& option) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw InputError(option, "", text, equipoise::words::chart::axis_form);
  return slice_axis(study, text.substr(0, equals), text.substr(equals + 1), points, option);
}

int run_chart(const ChartArguments& a) {
  begin_computing(a);
  const Study study = at_medians(read_study(a.study, a.overrides));
  const SliceSize size = map_size(a.size, "--size");
  ChartSettings settings;
  settings.x = chart_axis(study, a.x, size.width, "--x");
  settings.y = chart_axis(study, a.y, size.height, "--y");
  if (!(a.undecided > 0.0 && a.undecided < 100.0))
    throw InputError("--undecided", "", fmt::format("{}", a.undecided), equipoise::words::chart::undecided_range);
  settings.undecided = 0.01 * a.undecided;
  settings.boxes = a.boxes;
  check_forms(a);
  settings.output = a.output;
  settings.threads = threads_option(a.threads);
  settings.stop = &stop_flag();
  ProgressLine progress(a.quiet);
  settings.progress = progress.listener();
  const BifurcationChart chart = bifurcation_chart(study, settings);
  progress.finish();
  put_forms(a, {[&] { return chart_text(chart, text_style()); },
                [&] { return chart_json(chart); },
                [&] { return chart_csv(chart); },
                [&](const std::string& file) {
                  return chart_plot_script(
                      chart, display_text(std::filesystem::path(chart.study.name).filename().string()), file);
                },
                {}});
  return chart.complete ? done : ended_early(progress.left(), nullptr, "");
}

}  // namespace

Command add_chart(CLI::App& app) {
  const auto a = std::make_shared<ChartArguments>();
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_option("--x", a->x, help::chart::x)->type_name("KEY=LOW:HIGH");
  app.add_option("--y", a->y, help::chart::y)->type_name("KEY=LOW:HIGH");
  app.add_option("--size", a->size, help::chart::size)->type_name("WIDTHxHEIGHT");
  app.add_option("--boxes", a->boxes, help::chart::boxes)->type_name("N");
  app.add_option("--undecided", a->undecided, help::chart::undecided)->type_name("PERCENT");
  app.add_option("-o,--output", a->output, help::chart::output)->type_name("FILE");
  app.add_option("--csv", a->csv, help::chart::csv)->type_name("FILE");
  app.add_option("--plot", a->plot, help::chart::plot)->type_name("FILE");
  app.add_flag("--json", a->json, help::json);
  add_text_style(app);
  add_overrides(app, a->overrides);
  add_computing(app, *a);
  return [a] { return run_chart(*a); };
}

}  // namespace equipoise::app
