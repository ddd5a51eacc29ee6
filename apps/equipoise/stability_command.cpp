// equipoise stability: where balance is stable in a plane of two parameters.
#include <memory>
#include <string>

#include "equipoise/charts/stability_plot.hpp"
#include "equipoise/charts/stability_report.hpp"
#include "equipoise/stability/over_plane.hpp"
#include "plane_command.hpp"

namespace equipoise::app {

namespace {

struct StabilityArguments : PlaneArguments {
  std::string x = "speed.final", y = "balancer.drag", x_range, y_range;
};

int run_stability(const StabilityArguments& a) {
  return run_plane(
      a, StabilitySettings(),
      [&](const Study& study, const SliceSize& size, StabilitySettings& settings) {
        settings.x = slice_axis(study, a.x, a.x_range, size.width, "--x-range");
        settings.y = slice_axis(study, a.y, a.y_range, size.height, "--y-range");
      },
      [](const Study& study, const StabilitySettings& settings) { return stability(study, settings); },
      [](const StabilityPlane& plane, const std::string& title) {
        return FormMakers{[&] { return stability_text(plane, text_style()); },
                          [&] { return stability_json(plane); },
                          [&] { return stability_csv(plane); },
                          [&](const std::string& file) { return stability_plot_script(plane, title, file); },
                          {}};
      });
}

}  // namespace

Command add_stability(CLI::App& app) {
  const auto a = std::make_shared<StabilityArguments>();
  a->size = "512x512";
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  app.add_option("--x", a->x, help::stability::x)->type_name("KEY");
  app.add_option("--y", a->y, help::stability::y)->type_name("KEY");
  app.add_option("--x-range", a->x_range, help::stability::x_range)->type_name("LOW:HIGH");
  app.add_option("--y-range", a->y_range, help::stability::y_range)->type_name("LOW:HIGH");
  app.add_option("--size", a->size, help::stability::size)->type_name("WIDTHxHEIGHT");
  add_plane_forms(app, *a, {help::stability::output, help::stability::csv, help::stability::plot});
  return [a] { return run_stability(*a); };
}

}  // namespace equipoise::app
