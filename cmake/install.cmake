# Installing and exporting: find_package(equipoise) from an outside project.
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/equipoise)
install(TARGETS equipoise equipoise_paper EXPORT equipoise_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(EQUIPOISE_BUILD_PROGRAM)
  install(TARGETS equipoise_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# The public interface: equipoise/equipoise.hpp and equipoise/paper.hpp, and what they include. Templates and kernels stay inside.
foreach(header
    equipoise.hpp base/error.hpp base/run_options.hpp base/stop_flag.hpp
    model/balance_grade.hpp model/balanced_state.hpp model/energy.hpp model/machine.hpp model/motor.hpp
    model/parameters.hpp model/scales.hpp model/speed.hpp model/state_layout.hpp model/system.hpp
    types/attractor.hpp types/ball_events.hpp types/fate.hpp types/motion.hpp types/outcomes.hpp types/periodic_orbit.hpp types/status.hpp
    types/transient_table.hpp types/trap_hints.hpp
    statistics/quantile.hpp statistics/share.hpp statistics/sobol_indices.hpp sampling/jittered_grid.hpp sampling/sampling.hpp
    study/ball_details.hpp study/keys.hpp study/overrides.hpp study/physical_echo.hpp study/study.hpp study/study_value.hpp
    study/table_reader.hpp study/uncertain.hpp study/units.hpp
    model/ball_mode.hpp motions/catalogue.hpp motions/motion.hpp orbits/orbit.hpp proof/certificate.hpp proof/member_certificate.hpp
    results/attractors_result.hpp results/basin_result.hpp results/branch.hpp results/branches_result.hpp results/basin_cost.hpp results/capacity_result.hpp
    results/certify_result.hpp results/comparison_result.hpp results/design_result.hpp results/explanation.hpp results/inspection.hpp
    results/machine_page.hpp results/map_figures.hpp results/outcome_share.hpp results/plane_map.hpp results/sensitivity_result.hpp
    results/start_arrays.hpp results/sweep_result.hpp results/trajectory.hpp
    results/transient_figures.hpp results/transient_result.hpp
    store/basin_file.hpp store/basin_outcomes.hpp store/branches_file.hpp store/inspection.hpp store/map_file.hpp store/start_columns.hpp store/sweep_file.hpp
    store/trajectory_file.hpp
    basins/attractors.hpp basins/basin.hpp basins/certify.hpp basins/comparison.hpp basins/mapper.hpp basins/observation.hpp basins/sensitivity.hpp
    basins/write_basin.hpp
    branches/continuation.hpp branches/parameter_line.hpp kernels/cpu_target.hpp
    maps/map_axis.hpp maps/map_figures.hpp maps/plane_map.hpp sweeps/capacity.hpp sweeps/merge.hpp sweeps/sweep.hpp sweeps/sweep_axis.hpp sweeps/sweep_cell.hpp sweeps/sweep_plan.hpp
    design/design.hpp design/figures.hpp design/problem.hpp
    trajectory/output_times.hpp trajectory/simulate.hpp trajectory/study_equations.hpp drawing/map_plot.hpp drawing/plot_parts.hpp drawing/sweep_plot.hpp
    report/attractors_report.hpp report/basin_report.hpp report/branches_report.hpp report/certificate_json.hpp report/certify_report.hpp report/explain_report.hpp
    report/capacity_report.hpp report/comparison_report.hpp report/design_report.hpp report/inspection_report.hpp report/map_report.hpp
    report/sweep_report.hpp
    explain/explain.hpp
    pages/answer.hpp pages/capacity_html.hpp pages/design_html.hpp pages/given_keys.hpp pages/given_machine.hpp pages/machine_html.hpp shown/machine_page.hpp
    pages/map_html.hpp shown/motion_path.hpp pages/sweep_html.hpp
    paper.hpp literature/conclusions.hpp literature/published_tables.hpp
    literature/reproduction.hpp statistics/comparison.hpp reproduction/open_questions.hpp
    reproduction/paper_figures.hpp reproduction/reproduce.hpp
    reproduction/reproduction.hpp)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/equipoise/${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/equipoise/${folder})
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/src/equipoise/include/equipoise/base/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/equipoise/base)

install(EXPORT equipoise_targets NAMESPACE equipoise:: DESTINATION ${config_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/equipoise-config.cmake.in
  ${PROJECT_BINARY_DIR}/equipoise-config.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/equipoise-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/equipoise-config.cmake ${PROJECT_BINARY_DIR}/equipoise-config-version.cmake
  ${CMAKE_CURRENT_LIST_DIR}/udunits2.cmake
  DESTINATION ${config_dir})
