# Installing and exporting: find_package(equipoise) from an outside project.
include(CMakePackageConfigHelpers)

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/equipoise)
install(TARGETS equipoise EXPORT equipoise_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(EQUIPOISE_BUILD_PROGRAM)
  install(TARGETS equipoise_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# The public interface: equipoise/equipoise.hpp and what it includes. Templates and kernels stay inside.
foreach(header
    equipoise.hpp base/error.hpp model/balance_grade.hpp model/balanced_state.hpp model/energy.hpp model/machine.hpp
    model/motor.hpp model/parameters.hpp model/scales.hpp model/speed.hpp integrate/status.hpp
    ensemble/jittered_grid.hpp ensemble/sampling.hpp ensemble/transient_table.hpp attractors/balanced_continuum.hpp
    attractors/catalogue.hpp attractors/certificate.hpp attractors/decision_rule.hpp attractors/fate.hpp
    attractors/motion.hpp attractors/orbit.hpp statistics/comparison.hpp statistics/quantile.hpp statistics/share.hpp
    study/ball_details.hpp study/physical_echo.hpp study/study.hpp study/units.hpp literature/conclusions.hpp
    literature/paper_figure.hpp literature/published_tables.hpp literature/reproduction.hpp store/basin_file.hpp
    store/start_columns.hpp results/attractors_result.hpp results/basin_result.hpp
    results/branches_result.hpp results/certify_result.hpp results/explanation.hpp results/plane_map.hpp
    results/trajectory.hpp results/transient_result.hpp store/map_file.hpp store/trajectory_file.hpp report/attractors_report.hpp
    report/basin_report.hpp report/certify_report.hpp report/explain_report.hpp report/map_plot.hpp report/open_questions_result.hpp run/attractors.hpp run/basin.hpp run/certify.hpp
    run/explain.hpp run/observation.hpp run/open_questions.hpp run/paper_figures.hpp run/plane_map.hpp
    run/reproduce.hpp run/simulate.hpp)
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
