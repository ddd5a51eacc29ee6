# What other projects link, and what is installed: find_package(equipoise) gives the same names as add_subdirectory.
# Components of an installation: program, library (a shared one), development.
include(CMakePackageConfigHelpers)

# The public interface: equipoise/equipoise.hpp and equipoise/paper.hpp, and what they include. They are installed,
# and what they declare is what the shared library shows. Templates and kernels stay inside.
set(equipoise_public_headers
    equipoise.hpp paper.hpp
    base/error.hpp base/stop_flag.hpp
    running/run_options.hpp
    drives/full_state.hpp drives/motor.hpp drives/speed.hpp drives/spin_up_shape.hpp drives/torque_curve.hpp
    model/ball_mode.hpp model/bearings.hpp model/parameters.hpp model/scales.hpp model/state_layout.hpp model/system.hpp
    types/attractor.hpp types/ball_events.hpp types/fate.hpp types/motion.hpp types/outcomes.hpp
      types/periodic_orbit.hpp types/status.hpp types/transient_table.hpp types/warm_start_levels.hpp
    mechanics/balance_grade.hpp mechanics/balanced_state.hpp mechanics/energy.hpp mechanics/whirl.hpp
    statistics/comparison.hpp statistics/quantile.hpp statistics/share.hpp statistics/sobol_indices.hpp
    sampling/jittered_grid.hpp sampling/sampling.hpp
    units/units.hpp
    toml/overrides.hpp toml/study_value.hpp
    study/ball_details.hpp study/keys.hpp study/study.hpp study/table_reader.hpp study/uncertain.hpp
    echo/physical_echo.hpp
    kernels/cpu_target.hpp
    periodic_orbits/orbit.hpp
    attractors/catalogue.hpp attractors/motion.hpp
    proof/certificate.hpp proof/member_certificate.hpp
    columns/column.hpp columns/slice_figures.hpp columns/standard_levels.hpp columns/transient_figures.hpp columns/watched_shaft.hpp
    results/attractors_result.hpp results/basin_result.hpp results/basin_slice.hpp results/branch.hpp
      results/branches_result.hpp results/capacity_result.hpp results/certify_result.hpp results/comparison_result.hpp
      results/design_result.hpp results/explanation.hpp results/inspection.hpp results/machine_page.hpp
      results/motion_table.hpp results/outcome_share.hpp results/sensitivity_result.hpp results/start_arrays.hpp
      results/sweep_result.hpp results/trajectory.hpp results/transient_result.hpp
      results/without_balls.hpp
    result_files/basin_file.hpp result_files/basin_outcomes.hpp result_files/branches_file.hpp
      result_files/inspection.hpp result_files/slice_file.hpp result_files/start_columns.hpp
      result_files/trajectory_file.hpp
    cell_files/sweep_file.hpp
    ensembles/basin.hpp ensembles/write_basin.hpp
    analyses/attractors.hpp analyses/basin_cost.hpp analyses/certify.hpp analyses/comparison.hpp analyses/mapper.hpp
      analyses/observation.hpp analyses/sensitivity.hpp
    continuation/continuation.hpp continuation/parameter_line.hpp
    basin_slices/basin_slice.hpp basin_slices/slice_axis.hpp basin_slices/slice_figures.hpp
    planes/bifurcation_chart.hpp planes/chart_file.hpp planes/stability_file.hpp planes/stability_plane.hpp
      stability/over_plane.hpp curves/bifurcation_chart.hpp charts/chart_julia.hpp charts/chart_plot.hpp charts/chart_report.hpp
      charts/stability_plot.hpp charts/stability_report.hpp
    sweeps/capacity.hpp sweeps/merge.hpp sweeps/survey.hpp sweeps/sweep.hpp sweeps/sweep_axis.hpp
      sweeps/sweep_cell.hpp sweeps/sweep_plan.hpp sweeps/varied_unbalance.hpp
    design/design.hpp design/figures.hpp design/problem.hpp
    trajectory/output_times.hpp trajectory/simulate.hpp trajectory/study_equations.hpp
    shown/machine_page.hpp shown/motion_path.hpp
    drawing/document.hpp drawing/plot_parts.hpp
    text/table_text.hpp
    words/results.hpp
    decision/verdict.hpp
    changes/try_changes.hpp
    changes/usual_changes.hpp
    reports/attractors_report.hpp reports/basin_report.hpp reports/branches_report.hpp reports/capacity_report.hpp
      reports/certificate_json.hpp reports/certify_report.hpp reports/comparison_report.hpp reports/design_report.hpp
      design_words/design_words.hpp reports/explain_report.hpp reports/inspection_report.hpp reports/map_report.hpp reports/sweep_report.hpp
    plots/map_plot.hpp plots/sweep_plot.hpp
    explain/explain.hpp explain/new_studies.hpp explain/study_check.hpp
    answers/answer.hpp
    html/capacity_html.hpp html/design_html.hpp html/given_keys.hpp html/given_machine.hpp
      html/machine_html.hpp html/map_html.hpp html/sweep_html.hpp
    publications/measures.hpp publications/publication.hpp publications/publication_verdicts.hpp
    literature/conclusions.hpp literature/published_tables.hpp literature/reproduction.hpp
    reproduction/open_questions.hpp reproduction/paper_figures.hpp reproduction/reproduce.hpp
      reproduction/reproduction.hpp)

if(EQUIPOISE_SHARED)
  include(cmake/shared.cmake)
  set(libraries equipoise_shared equipoise_shared_paper)
else()
  set(libraries equipoise equipoise_paper)
  set_target_properties(equipoise_paper PROPERTIES EXPORT_NAME paper)
endif()
list(GET libraries 0 library)
list(GET libraries 1 paper)
add_library(equipoise::equipoise ALIAS ${library})
add_library(equipoise::paper ALIAS ${paper})

if(NOT EQUIPOISE_INSTALL)
  return()
endif()

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/equipoise)
install(TARGETS ${libraries} EXPORT equipoise_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
foreach(header IN LISTS equipoise_public_headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/equipoise/${header}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/equipoise/${folder} COMPONENT development)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/src/equipoise/include/equipoise/base/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/equipoise/base COMPONENT development)

# For CMake. While the first number of the version is 0, its second one breaks what was; afterwards the first alone does.
set(compatible SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatible SameMinorVersion)
endif()
install(EXPORT equipoise_targets NAMESPACE equipoise:: DESTINATION ${config_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/equipoise-config.cmake.in
  ${PROJECT_BINARY_DIR}/equipoise-config.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/equipoise-config-version.cmake COMPATIBILITY ${compatible})
set(config_files ${PROJECT_BINARY_DIR}/equipoise-config.cmake ${PROJECT_BINARY_DIR}/equipoise-config-version.cmake)
install(FILES ${config_files} DESTINATION ${config_dir} COMPONENT development)

# For all else: pkg-config. A static library names what it needs.
set(pkg_config_libraries -lequipoise)
set(pkg_config_requires eigen3)
if(NOT EQUIPOISE_SHARED)
  set(pkg_config_libraries "-lequipoise_paper -lequipoise -pthread")
  string(APPEND pkg_config_requires ", tbb, fmt, tomlplusplus, libhwy, netcdf")
  if(EQUIPOISE_PAGMO)
    string(APPEND pkg_config_libraries " -lpagmo -lboost_serialization")
  endif()
endif()
set(pkg_config_prefix ${CMAKE_INSTALL_PREFIX})
if(NOT CMAKE_INSTALL_PREFIX STREQUAL /usr)  # may be moved
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  set(pkg_config_prefix "\${pcfiledir}/${up}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/equipoise.pc.in ${PROJECT_BINARY_DIR}/equipoise.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/equipoise.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(EQUIPOISE_BUILD_PROGRAM)
  include(cmake/install_program.cmake)
endif()
