# Tests of ensembles: lanes, windows, deciding, same bits; the program; the published tables.
equipoise_test(pack_test unit unit/pack_test.cpp)
target_include_directories(pack_test PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_definitions(pack_test PRIVATE ${equipoise_kernel_definitions})
equipoise_test(kernel_speed_test unit unit/kernel_speed_test.cpp LIBRARIES equipoise_paper)
target_compile_options(kernel_speed_test PRIVATE $<$<CONFIG:Release>:-O3>)  # of its own integrator too
set_target_properties(kernel_speed_test PROPERTIES DISABLE_PRECOMPILE_HEADERS ON)  # they are for -O1
equipoise_test(statistics_test unit unit/statistics_test.cpp unit/standards_test.cpp unit/comparison_test.cpp unit/quantile_test.cpp
  unit/sobol_indices_test.cpp)
equipoise_test(sampling_test unit unit/random_test.cpp unit/sampling_test.cpp unit/even_share_test.cpp
  unit/search_log_test.cpp unit/stopped_following_test.cpp unit/stopped_spin_up_test.cpp)
equipoise_test(reproduction_test unit unit/balanced_text_test.cpp unit/document_test.cpp unit/published_tables_test.cpp LIBRARIES equipoise_paper nlohmann_json::nlohmann_json)
equipoise_test(publications_test literature literature/publications_test.cpp literature/reversed_sign_test.cpp LIBRARIES equipoise_paper
  LONG Publications.StandInTheDocumentationWithTheseVerdicts)
equipoise_test(store_test unit unit/netcdf_threads_test.cpp unit/store_test.cpp)
equipoise_test(report_test unit unit/report_test.cpp LIBRARIES nlohmann_json::nlohmann_json)
equipoise_test(answer_test unit unit/answer_test.cpp unit/cell_answer_test.cpp)
equipoise_test(machine_page_test equivalence equivalence/machine_page_test.cpp)
equipoise_test(window_test unit unit/window_test.cpp)
equipoise_test(window_sampling_test equivalence equivalence/window_sampling_test.cpp)
equipoise_test(stopped_search_test equivalence equivalence/stopped_search_test.cpp)
equipoise_test(feature_trends_test unit unit/feature_trends_test.cpp)
equipoise_test(pilot_test unit unit/pilot_test.cpp)
equipoise_test(smooth_batch_test equivalence equivalence/smooth_batch_test.cpp)
equipoise_test(hybrid_batch_test equivalence equivalence/hybrid_batch_test.cpp)
equipoise_test(event_fates_test equivalence equivalence/event_fates_test.cpp
  LONG BranchesWithEvents.FollowWhatTouchesAndWhatSticks Of/EventFates.HoldTwentyTimesLater/stiction_gravity
  Of/EventFates.HoldTwentyTimesLater/stiction_motor)
equipoise_test(many_balls_fates_test equivalence equivalence/many_balls_fates_test.cpp LIBRARIES equipoise_machine_follow
  LONG Of/ManyBalls.ComeToWhatTheyAreSaidTo/of_12 Of/ManyBalls.ComeToWhatTheyAreSaidTo/of_16
  Of/ManyBalls.ComeToWhatTheyAreSaidTo/of_16_of_three_kinds)
equipoise_test(smooth_fates_test equivalence equivalence/smooth_fates_test.cpp LIBRARIES equipoise_machine_follow)
equipoise_test(stalled_fates_test equivalence equivalence/stalled_fates_test.cpp LIBRARIES equipoise_machine_follow
  LONG Case/StalledFates.StandStillForGood/dry_friction_and_contact)
equipoise_test(basin_test equivalence equivalence/basin_test.cpp equivalence/basin_sampling_test.cpp equivalence/full_state_test.cpp)
equipoise_test(decisions_test equivalence equivalence/decisions_test.cpp)
equipoise_test(lingering_test equivalence equivalence/lingering_test.cpp)
equipoise_test(continuum_decisions_test equivalence equivalence/continuum_decisions_test.cpp
  LONG ContinuumDecisions.UnequalSupportsLeaveNextToNothingUndecided)
equipoise_test(continuum_estimate_test equivalence equivalence/continuum_estimate_test.cpp)
equipoise_test(horizon_test equivalence equivalence/horizon_test.cpp)
equipoise_test(stroboscopic_test equivalence equivalence/stroboscopic_test.cpp)
equipoise_test(touching_balance_test equivalence equivalence/touching_balance_test.cpp)
equipoise_test(drawn_starts_test equivalence equivalence/drawn_starts_test.cpp)
equipoise_test(own_rotors_test equivalence equivalence/own_rotors_test.cpp
  LONG OwnRotorShares.AreTheMeanOfKnownRotors)
equipoise_test(own_starts_test equivalence equivalence/own_starts_test.cpp)
equipoise_test(watched_starts_test equivalence equivalence/watched_starts_test.cpp)
equipoise_test(basin_slice_test equivalence equivalence/basin_slice_test.cpp
  LONG BasinSlice.BlocksLeaveOutWhatIsWithinOneBasin BasinSlice.LongAccurateTrajectoriesShakeAsTheMapSays
  BasinSlice.FollowsOnBeyondTheHorizonWhereALineComesToSomething)
equipoise_test(comparison_result_test unit unit/comparison_result_test.cpp)
equipoise_test(slice_figures_test unit unit/slice_figures_test.cpp unit/pixel_plan_test.cpp)
equipoise_test(design_problem_test unit unit/design_problem_test.cpp unit/design_search_test.cpp)
equipoise_test(design_test equivalence equivalence/design_test.cpp
  LONG Design.HoldsOverWhatEachStartDraws)
equipoise_test(sweep_test unit unit/chunks_test.cpp unit/sweep_test.cpp)
equipoise_test(sweep_tables_test long literature/sweep_tables_test.cpp LIBRARIES equipoise_paper)
equipoise_test(continuation_test equivalence equivalence/continuation_test.cpp
  LONG Branches.ThinBasinOfATorusIsFollowedThrough Branches.TorusThatTurnsChaoticAndLocksKeepsItsIdentifier)
equipoise_test(observation_test equivalence equivalence/observation_test.cpp)
equipoise_test(library_face_test equivalence equivalence/library_face_test.cpp LIBRARIES equipoise_paper)
equipoise_test(transients_test equivalence equivalence/transients_test.cpp)
equipoise_test(verdict_test equivalence equivalence/verdict_test.cpp equivalence/standards_of_starts_test.cpp
  equivalence/capacity_goals_test.cpp LIBRARIES nlohmann_json::nlohmann_json)
equipoise_test(few_starts_test equivalence equivalence/few_starts_test.cpp)
equipoise_test(without_balls_test equivalence equivalence/without_balls_test.cpp unit/limits_kept_test.cpp
  unit/no_balls_test.cpp LIBRARIES nlohmann_json::nlohmann_json)
equipoise_test(hill_spin_up_test equivalence equivalence/hill_spin_up_test.cpp)
equipoise_test(drive_work_test equivalence equivalence/drive_work_test.cpp)
equipoise_test(table_7_test equivalence equivalence/table_7_test.cpp literature/table_7_protocol.cpp LIBRARIES equipoise_paper)
if(EQUIPOISE_SANITIZE)  # instrumented kernels run at a hundredth of the speed
  target_compile_definitions(decisions_test PRIVATE DECISION_STARTS=40 BALL_COUNT_STARTS=20)
else()
  target_compile_definitions(decisions_test PRIVATE DECISION_STARTS=1000 BALL_COUNT_STARTS=100)
endif()

# The search for table 7's protocol: minutes to hours, run by hand (docs/evidence/table-7.md).
add_executable(table_7_evidence literature/table_7_evidence.cpp literature/table_7_elsewhere.cpp
  literature/table_7_fit.cpp literature/table_7_protocol.cpp literature/table_7_variants.cpp)
target_compile_options(table_7_evidence PRIVATE -Wall -Wextra)
target_link_libraries(table_7_evidence PRIVATE equipoise_paper fmt::fmt)

find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND AND EQUIPOISE_BUILD_PROGRAM)
  function(cli_test name script)
    add_test(NAME ${name}
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/cli/${script} $<TARGET_FILE:equipoise_program>
        ${PROJECT_SOURCE_DIR}/studies)
    set_tests_properties(${name} PROPERTIES LABELS cli TIMEOUT ${longest_test} ENVIRONMENT ${test_environment})
  endfunction()
  cli_test(cli.program_as_its_users_meet_it cli_test.py)
  cli_test(cli.refusals_of_the_snapshot refusals_test.py)
  cli_test(cli.basin basin_test.py)
  cli_test(cli.streams_and_usage streams_test.py)
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

  # Every table from a few thousand starts a row, judged by the errors of both samples (exit code 3 if a cell that is
  # claimed to agree differs); at the paper's sample sizes: ./dev validate.
  set(literature_starts 4000)
  if(EQUIPOISE_SANITIZE)
    set(literature_starts 300)
  endif()
  foreach(table RANGE 1 7)
    add_test(NAME literature.table_${table}_agrees_with_the_published_one
      COMMAND equipoise_program reproduce table-${table} --law published --starts ${literature_starts} --quiet)
    set_tests_properties(literature.table_${table}_agrees_with_the_published_one PROPERTIES LABELS literature TIMEOUT ${longest_test})
  endforeach()
endif()
