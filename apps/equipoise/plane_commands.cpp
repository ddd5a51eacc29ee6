// The commands about a plane of two quantities: map, stability, chart.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands.hpp"
#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/display_text.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "result_forms.hpp"
#include "streams.hpp"
#include "time_limit.hpp"

namespace equipoise::app {

namespace {

/// Axes as typed: KEY=LOW:HIGH, or KEY with LOW:HIGH in its range.
struct PlaneArguments : ResultForms {
  std::string x, y, x_range, y_range, size;
};

SliceAxis axis_of(const Study& study, const std::string& text, const std::string& range, int pixels,
                  const std::string& option) {
  const std::string range_option = option + "-range";
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos && range.empty() && !SliceAxis{text, 0.0, 1.0, pixels}.angle())
    throw InputError(option, text, "",
                     fmt::format("has no range; must be LOW:HIGH, e.g. {0} {1}={2} or {0}-range {2}", option, text,
                                 text.starts_with("speed") ? "1.5:6" : "0.01:0.5"));
  if (equals == std::string::npos) return slice_axis(study, text, range, pixels, range_option);
  if (!range.empty())
    throw InputError(range_option, "", display_text(range),
                     fmt::format("{} already gives a range; give it only once", option));
  if (equals == 0 || equals + 1 == text.size())
    throw InputError(option, "", display_text(text), "must be KEY=LOW:HIGH, e.g. speed.final=0.5:6");
  return slice_axis(study, text.substr(0, equals), text.substr(equals + 1), pixels, option);
}

StabilityPlane computed(const Study& study, const StabilitySettings& how) { return stability(study, how); }
BifurcationChart computed(const Study& study, const ChartSettings& how) { return bifurcation_chart(study, how); }
BasinSlice computed(const Study& study, const BasinSliceSettings& how) { return basin_slice(study, how); }

// They refer to the result and the source.
FormMakers forms_of(const StabilityPlane& plane, const StudySource&) {
  return {plane.study,
          [&] { return document_of(plane); },
          [&] { return json_text(plane); },
          [&] { return stability_csv(plane); },
          {}};
}
FormMakers forms_of(const BifurcationChart& chart, const StudySource&) {
  return {chart.plane.study,
          [&] { return document_of(chart); },
          [&] { return json_text(chart); },
          [&] { return chart_csv(chart); },
          {}};
}
FormMakers forms_of(const BasinSlice& map, const StudySource& source) {
  return {map.study,
          [&] { return document_of(map); },
          [&] { return json_text(map); },
          {},
          [&] { return given_machine(source.toml, source.name, source.overrides); }};
}

/// Reads the study, computes and puts out. `made`: what errors call the result; `keeper`: where the command keeps its
/// work; `settings(study)`: what it has in addition to axes. computed() and forms_of() are those of the settings and
/// the result.
template <class Settings>
int run_plane(const PlaneArguments& a, const char* made, Keeper keeper, const Settings& settings) {
  begin_computing(a);
  const StudySource source = source_of(a);
  const Study study = at_medians(source.with());
  auto how = settings(study);
  const SliceSize size = map_size(a.size, "--size");
  how.x = axis_of(study, a.x, a.x_range, size.width, "--x");
  how.y = axis_of(study, a.y, a.y_range, size.height, "--y");
  check_forms(a);
  how.output = a.output;
  how.threads = threads_option(a.threads);
  how.stop = &stop_flag();
  ProgressLine progress(a.quiet, how);
  const auto result = [&] {
    try {
      return computed(study, how);
    } catch (const InputError& e) {
      throw under_names(e, how.x, how.y, {"--x", "--y", "--size", made});
    }
  }();
  progress.finish();
  if constexpr (requires { result.read_whole; })
    if (result.read_whole) say("read from {}", a.output);
  put_forms(a, forms_of(result, source));
  return result.complete ? done : ended_early(progress.left(), keeper, keeper ? a.output : "");
}

/// STUDY and the axes; `x`, `y`, `size` are what a command's help says of them.
void add_axes(CLI::App& app, PlaneArguments& a, const char* x, const char* y, const char* size) {
  add_study(app, a);
  app.add_option("--x", a.x, x)->type_name("KEY[=LOW:HIGH]");
  app.add_option("--y", a.y, y)->type_name("KEY[=LOW:HIGH]");
  app.add_option("--x-range", a.x_range, "the range of --x, if it names only a key")->type_name("LOW:HIGH");
  app.add_option("--y-range", a.y_range, "the same for --y")->type_name("LOW:HIGH");
  app.add_option("--size", a.size, size)->type_name("WIDTHxHEIGHT");
}

void add_parameters(CLI::App& app, PlaneArguments& a, const char* size) {
  add_axes(app, a,
           "what varies from left to right: a key of rotor, balancer or speed that takes a number, and its range, e.g. "
           "speed.final=0.5:6, \"speed.final=900 rpm:4000 rpm\" (default speed.final)",
           "the same from bottom to top (default balancer.drag)", size);
}

template <class Arguments>
std::shared_ptr<Arguments> arguments_over(const char* x, const char* y, const char* size) {
  auto a = std::make_shared<Arguments>();
  a->x = x;
  a->y = y;
  a->size = size;
  return a;
}

struct ChartArguments : PlaneArguments {
  std::optional<std::string> boxes;
  double undecided = 1.0;
  bool cycles = false;
};

ChartSettings chart_settings(const ChartArguments& a) {
  ChartSettings settings;
  if (!(a.undecided > 0.0 && a.undecided < 100.0))
    throw InputError("--undecided", "", fmt::format("{}", a.undecided),
                     "must be a part of the plane in percent, more than 0 and less than 100");
  settings.undecided = 0.01 * a.undecided;
  constexpr std::uint64_t most_boxes = 1'000'000'000;
  if (a.boxes)
    settings.boxes =
        option_number<std::uint64_t>("--boxes", *a.boxes, 0, most_boxes, "a whole number from 0 to 1000000000");
  settings.cycles = a.cycles;
  return settings;
}

struct MapArguments : PlaneArguments {
  std::vector<std::string> ties;
};

BasinSliceSettings map_settings(const MapArguments& a, const Study& study) {
  check_has_balls(study);
  BasinSliceSettings settings;
  for (const std::string& tie : a.ties) settings.links.push_back(angle_link(tie, "--tie"));
  return settings;
}

}  // namespace

Command add_stability(CLI::App& app) {
  const auto a = arguments_over<PlaneArguments>("speed.final", "balancer.drag", "512x512");
  add_parameters(app, *a, "points (default 512x512)");
  app.add_option("-o,--output", a->output, "all points as NetCDF (.nc)")->type_name("FILE");
  add_forms(
      app, *a,
      {"one line per point (.csv)", "a picture shaded by decay and growth, with the boundaries by their kind", false});
  add_usual(app, *a);
  return [a] { return run_plane(*a, "stability", nullptr, [](const Study&) { return StabilitySettings(); }); };
}

Command add_chart(CLI::App& app) {
  const auto a = arguments_over<ChartArguments>("speed.final", "balancer.drag", "64x64");
  add_parameters(app, *a, "grid from which curves are followed (default 64x64)");
  app.add_option("--boxes", a->boxes, "maximum number of boxes for proofs (default 200000); 0 for no proofs")
      ->type_name("N");
  app.add_option("--undecided", a->undecided, "proofs end once at most this much of the plane is undecided (default 1)")
      ->type_name("PERCENT");
  app.add_flag("--cycles", a->cycles, "also follow bifurcations of the cycles born at Hopf points; may take minutes");
  app.add_option("-o,--output", a->output, "curves, points and boxes as NetCDF (.nc)")->type_name("FILE");
  add_forms(app, *a, {"one line per point of a curve (.csv)", "a picture of curves, points and boxes", false});
  add_usual(app, *a);
  return [a] { return run_plane(*a, "stability", nullptr, [&](const Study&) { return chart_settings(*a); }); };
}

Command add_map(CLI::App& app) {
  const auto a = arguments_over<MapArguments>("initial.phi_1", "initial.phi_2", "512x512");
  add_axes(app, *a,
           "what varies from left to right: a key of rotor, balancer, speed, release or initial that takes a number, "
           "and its range, e.g. initial.phi_1=-pi/2:pi/2 (default initial.phi_1; ball angles: a whole turn)",
           "the same from bottom to top (default initial.phi_2)", "pixels (default 512x512)");
  app.add_option("--tie", a->ties, "tie a ball angle to another, e.g. phi_2=phi_1+pi; may be repeated")
      ->type_name("PHI_I=PHI_J+ANGLE")
      ->take_all();
  app.add_option(
         "-o,--output", a->output,
         "every pixel's outcome and time as NetCDF (.nc), saved as they finish; rerun to resume an interrupted map or "
         "to reload a finished one")
      ->type_name("FILE");
  add_forms(app, *a, {nullptr, "a picture, darker where decided later"});
  add_usual(app, *a);
  return [a] { return run_plane(*a, "map", kept_by_output, [&](const Study& s) { return map_settings(*a, s); }); };
}

}  // namespace equipoise::app
