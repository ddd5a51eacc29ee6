// The grid, then curves and regions, then the proof and curves that it shows, then cycles.
#include "equipoise/extras/curves/bifurcation_chart.hpp"

#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/running/run_info.hpp"
#include "equipoise/extras/curves/curve_starts.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "equipoise/simulation/kernels/long_call.hpp"

namespace equipoise {

namespace {

BifurcationChart computed_chart(const Study& study, const ChartSettings& settings) {
  const RunClock clock;
  // An axis may bring what the study itself has not, such as gravity.
  const PlaneStudies plane(study, settings.x, settings.y,
                           [](const Study& there) { check_offers(there, model::ResultKind::curves); });
  BifurcationChart chart;
  chart.plane.study = study;
  chart.plane.x = settings.x;
  chart.plane.y = settings.y;
  chart.cycles = settings.cycles;
  if (!settings.output.empty()) check_chart_file(settings.output, chart);
  chart.plane = stability(plane, settings);
  if (chart.plane.complete) {
    add_curves(plane, settings.stop, chart);
    add_locked_states(plane, chart.plane.threads, settings.stop, chart);
    chart.undecided = settings.undecided;
    if (settings.boxes > 0) add_proof_boxes(plane, settings.boxes, settings.undecided, settings.stop, chart);
    add_curves_between_boxes(plane, settings.stop, chart);
    if (settings.cycles && !is_set(settings.stop)) add_cycles(plane, settings, chart);  // which then shows what it left
  }
  chart.complete = chart.plane.complete && !is_set(settings.stop);
  if (!settings.output.empty()) write_chart_file(settings.output, chart);
  chart.plane.took(clock.time());
  return chart;
}

}  // namespace

BifurcationChart bifurcation_chart(const Study& given, const ChartSettings& settings) {
  const Study study = with_medians(given);
  check_offers(study, model::ResultKind::curves);
  return long_call(settings, [&](const ChartSettings& s) { return computed_chart(study, s); });
}

}  // namespace equipoise
