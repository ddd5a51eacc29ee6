# Tests of the program: as its users meet it, with faults, and against the published tables.
if(NOT Python3_FOUND OR NOT EQUIPOISE_BUILD_PROGRAM)
  return()
endif()
# With an entry of its own for the cases that the script marks as slow.
function(cli_test name script)
  set(path ${CMAKE_CURRENT_SOURCE_DIR}/cli/${script})
  set(command ${Python3_EXECUTABLE} -B ${path} $<TARGET_FILE:equipoise_program> ${PROJECT_SOURCE_DIR}/studies)
  add_test(NAME ${name} COMMAND ${command})
  set_tests_properties(${name} PROPERTIES LABELS cli TIMEOUT ${longest_test} ENVIRONMENT ${test_environment})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${path})
  file(STRINGS ${path} slow REGEX "^ *@slow$")
  if(slow)
    add_test(NAME ${name}.slow COMMAND ${command} --slow)
    set_tests_properties(${name}.slow PROPERTIES LABELS full TIMEOUT ${longest_test} ENVIRONMENT ${test_environment})
  endif()
endfunction()
cli_test(cli.program_as_its_users_meet_it cli_test.py)
cli_test(cli.refusals_of_the_snapshot refusals_test.py)
cli_test(cli.basin basin_test.py)
cli_test(cli.forged_files forged_test.py)
cli_test(cli.streams_and_usage streams_test.py)
cli_test(cli.stops_and_bounds stops_test.py)
cli_test(cli.attractors_and_proofs attractors_test.py)
cli_test(cli.attractors_along_a_parameter along_test.py)
cli_test(cli.compare compare_test.py)
cli_test(cli.map map_test.py)
cli_test(cli.stability stability_test.py)
cli_test(cli.chart chart_test.py)
cli_test(cli.new_and_check new_test.py)
cli_test(cli.report report_test.py)
cli_test(cli.sweep_merge_inspect sweep_test.py)
cli_test(cli.capacity capacity_test.py)
cli_test(cli.within within_test.py)
cli_test(cli.design design_test.py)
cli_test(cli.reproduce_as_its_users_meet_it reproduce_test.py)
add_test(NAME cli.without_mpi
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/cli/without_mpi_test.py
    $<TARGET_FILE:equipoise_without_mpi> ${PROJECT_SOURCE_DIR}/studies)
set_tests_properties(cli.without_mpi PROPERTIES LABELS cli TIMEOUT ${longest_test} ENVIRONMENT ${test_environment})

if(NOT EQUIPOISE_SANITIZE)  # runs are killed at moments measured in seconds
  add_test(NAME faults.nothing_is_lost
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/faults/faults.py $<TARGET_FILE:equipoise_program>
      ${PROJECT_SOURCE_DIR}/studies --quick)
  set_tests_properties(faults.nothing_is_lost PROPERTIES LABELS faults TIMEOUT ${longest_test} COST 130)
endif()

# Every table from a few thousand starts per row, judged by the errors of both samples (exit code 3 if a cell that is
# claimed to agree differs); at the paper's sample sizes: ./dev validate.
set(literature_starts 4000)
if(EQUIPOISE_SANITIZE)
  set(literature_starts 300)
endif()
foreach(table RANGE 1 7)
  add_test(NAME literature.table_${table}_agrees_with_the_published_one
    COMMAND equipoise_program reproduce table-${table} --law published --starts ${literature_starts} --quiet)
  set_tests_properties(literature.table_${table}_agrees_with_the_published_one PROPERTIES LABELS published TIMEOUT ${longest_test})
endforeach()
