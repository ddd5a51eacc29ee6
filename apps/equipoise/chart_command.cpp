// equipoise chart: curves in a plane of two parameters on which balance changes.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "equipoise/extras/charts/chart_report.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "plane_command.hpp"
#include "words.hpp"

namespace equipoise::app {

namespace {

struct ChartArguments : PlaneArguments {
  std::optional<std::string> boxes;
  double undecided = 1.0;
  bool cycles = false;
};

int run_chart(const ChartArguments& a) {
  return run_plane(
      a, ChartSettings(),
      [&](ChartSettings& settings) {
        if (!(a.undecided > 0.0 && a.undecided < 100.0))
          throw InputError("--undecided", "", fmt::format("{}", a.undecided), words::undecided_range);
        settings.undecided = 0.01 * a.undecided;
        constexpr std::uint64_t most_boxes = 1'000'000'000;
        if (a.boxes)
          settings.boxes = option_number<std::uint64_t>("--boxes", *a.boxes, 0, most_boxes, words::box_range);
        settings.cycles = a.cycles;
      },
      [](const Study& study, const ChartSettings& settings) { return bifurcation_chart(study, settings); },
      [](const BifurcationChart& chart) {
        return FormMakers{[&chart] { return chart_text(chart, text_style()); },
                          [&chart] { return chart_json(chart); },
                          [&chart] { return chart_csv(chart); },
                          [&chart] { return chart_plot(chart, file_title(chart.study)); },
                          {}};
      });
}

}  // namespace

Command add_chart(CLI::App& app) {
  const auto a = std::make_shared<ChartArguments>();
  static_cast<PlaneAxes&>(*a) = {"speed.final", "balancer.drag", "", "", "64x64"};
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  add_plane_axes(app, *a, help::parameter_x, help::parameter_y, help::chart::size);
  app.add_option("--boxes", a->boxes, help::chart::boxes)->type_name("N");
  app.add_option("--undecided", a->undecided, help::chart::undecided)->type_name("PERCENT");
  app.add_flag("--cycles", a->cycles, help::chart::cycles);
  add_plane_forms(app, *a, {help::chart::output, help::chart::csv, help::chart::plot});
  return [a] { return run_chart(*a); };
}

}  // namespace equipoise::app
