// The library's front door: a study in; shares, attractors, proofs or a trajectory out.
//
//     const equipoise::Study study = equipoise::read_study("spin-up.toml");
//     const equipoise::BasinResult answer = equipoise::basin(study);
//     const equipoise::Share& balanced = answer.attractors.front().share;
//     // balanced.share, balanced.low, balanced.high
//     const equipoise::Trajectory one = equipoise::simulate(study, {0.0, 10.0, 20.0});
//
// The library throws equipoise::InputError for unusable input before any work starts and RunError for work it cannot
// finish. It does not print, exit or abort. docs/reference/cpp.md is the tour.
#pragma once

#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/basin_slices/slice_figures.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/analyses/design/design.hpp"
#include "equipoise/analyses/design/problem.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/write_basin.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/analyses/one_study/basin_cost.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/analyses/one_study/observation.hpp"
#include "equipoise/analyses/one_study/sensitivity.hpp"
#include "equipoise/analyses/sweeps/capacity.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/attractors/motions/motion.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/planes/bifurcation_chart.hpp"
#include "equipoise/extras/planes/stability_plane.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/machine/balance/balanced_state.hpp"
#include "equipoise/machine/mechanics/energy.hpp"
#include "equipoise/machine/mechanics/whirl.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/report/answers/design_words.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/new_studies.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/plots/plots.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/shown/machine_page.hpp"
#include "equipoise/report/shown/motion_path.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/results/result_files/branches_file.hpp"
#include "equipoise/results/result_files/inspection.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "equipoise/results/result_files/trajectory_file.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/toml/overrides.hpp"
