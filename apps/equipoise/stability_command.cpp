// equipoise stability: where balance is stable in a plane of two parameters.
#include <memory>
#include <string>

#include "equipoise/extras/charts/stability_report.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "plane_command.hpp"

namespace equipoise::app {

namespace {

int run_stability(const PlaneArguments& a) {
  return run_plane(
      a, StabilitySettings(), [](StabilitySettings&) {},
      [](const Study& study, const StabilitySettings& settings) { return stability(study, settings); },
      [](const StabilityPlane& plane) {
        return FormMakers{[&] { return stability_text(plane, text_style()); },
                          [&] { return stability_json(plane); },
                          [&] { return stability_csv(plane); },
                          [&] { return stability_plot(plane, file_title(plane.study)); },
                          {}};
      });
}

}  // namespace

Command add_stability(CLI::App& app) {
  const auto a = std::make_shared<PlaneArguments>();
  static_cast<PlaneAxes&>(*a) = {"speed.final", "balancer.drag", "", "", "512x512"};
  app.add_option("study", a->study, help::study)->required()->type_name("STUDY");
  add_plane_axes(app, *a, help::parameter_x, help::parameter_y, help::stability::size);
  add_plane_forms(app, *a, {help::stability::output, help::stability::csv, help::stability::plot});
  return [a] { return run_stability(*a); };
}

}  // namespace equipoise::app
