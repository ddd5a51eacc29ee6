// The library's front door: a study in; shares, attractors, proofs or a trajectory out.
//
//     const equipoise::Study study = equipoise::read_study("spin-up.toml");
//     const equipoise::BasinResult answer = equipoise::basin(study);
//     const equipoise::Share& balanced = answer.attractors.front().share;
//     // balanced.share, balanced.low, balanced.high
//     const equipoise::Trajectory one = equipoise::simulate(study, {0.0, 10.0, 20.0});
//
// The library throws equipoise::InputError for unusable input before any work starts and RunError for work it cannot
// finish. It does not print, exit or abort. docs/guide/library.md is the tour.
#pragma once

#include "equipoise/base/error.hpp"
#include "equipoise/base/run_options.hpp"
#include "equipoise/base/version.hpp"
#include "equipoise/basins/attractors.hpp"
#include "equipoise/basins/basin.hpp"
#include "equipoise/basins/certify.hpp"
#include "equipoise/basins/comparison.hpp"
#include "equipoise/basins/observation.hpp"
#include "equipoise/basins/sensitivity.hpp"
#include "equipoise/branches/continuation.hpp"
#include "equipoise/drawing/map_plot.hpp"
#include "equipoise/drawing/sweep_plot.hpp"
#include "equipoise/explain/explain.hpp"
#include "equipoise/kernels/cpu_target.hpp"
#include "equipoise/maps/map_axis.hpp"
#include "equipoise/maps/map_figures.hpp"
#include "equipoise/maps/plane_map.hpp"
#include "equipoise/model/balanced_state.hpp"
#include "equipoise/model/energy.hpp"
#include "equipoise/pages/answer.hpp"
#include "equipoise/pages/capacity_html.hpp"
#include "equipoise/pages/given_keys.hpp"
#include "equipoise/pages/given_machine.hpp"
#include "equipoise/pages/machine_html.hpp"
#include "equipoise/pages/machine_page.hpp"
#include "equipoise/pages/map_html.hpp"
#include "equipoise/pages/sweep_html.hpp"
#include "equipoise/report/attractors_report.hpp"
#include "equipoise/report/basin_report.hpp"
#include "equipoise/report/branches_report.hpp"
#include "equipoise/report/capacity_report.hpp"
#include "equipoise/report/certify_report.hpp"
#include "equipoise/report/comparison_report.hpp"
#include "equipoise/report/explain_report.hpp"
#include "equipoise/report/inspection_report.hpp"
#include "equipoise/report/map_report.hpp"
#include "equipoise/report/sweep_report.hpp"
#include "equipoise/store/branches_file.hpp"
#include "equipoise/store/inspection.hpp"
#include "equipoise/store/map_file.hpp"
#include "equipoise/store/trajectory_file.hpp"
#include "equipoise/study/ball_details.hpp"
#include "equipoise/study/physical_echo.hpp"
#include "equipoise/study/study.hpp"
#include "equipoise/sweeps/capacity.hpp"
#include "equipoise/sweeps/merge.hpp"
#include "equipoise/sweeps/sweep.hpp"
#include "equipoise/sweeps/sweep_axis.hpp"
#include "equipoise/sweeps/sweep_plan.hpp"
#include "equipoise/trajectory/output_times.hpp"
#include "equipoise/trajectory/simulate.hpp"
