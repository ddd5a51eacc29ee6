# Tests of the study reader, of the shipped studies and of the house's layers.
equipoise_test(study_test unit unit/study_test.cpp unit/study_errors_test.cpp unit/study_tree_test.cpp unit/study_keys_test.cpp
  unit/sampling_box_test.cpp)
equipoise_test(physical_study_test unit unit/units_test.cpp unit/physical_study_test.cpp
  unit/motor_curve_test.cpp unit/data_sheet_study_test.cpp unit/datasheet_test.cpp LIBRARIES rapidcheck)
equipoise_test(unit_table_test unit unit/unit_table_test.cpp)
equipoise_test(read_number_test unit unit/read_number_test.cpp)
equipoise_test(uncertain_test unit unit/uncertain_test.cpp)
equipoise_test(display_text_test unit unit/display_text_test.cpp)
equipoise_test(deadline_test unit unit/deadline_test.cpp)
equipoise_test(reporting_test unit unit/reporting_test.cpp)
equipoise_test(form_test unit unit/form_test.cpp)
equipoise_test(drawn_rules_test equivalence equivalence/drawn_rules_test.cpp)
equipoise_test(explain_test unit unit/explain_test.cpp unit/explain_balance_test.cpp
  unit/explain_motor_test.cpp unit/rules_of_thumb_test.cpp unit/study_check_test.cpp LIBRARIES nlohmann_json::nlohmann_json)

find_package(Python3 COMPONENTS Interpreter)
if(Python3_FOUND)
  add_test(NAME layers.include_leftwards_only
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/layers_test.py ${PROJECT_SOURCE_DIR})
  add_test(NAME layers.faults_are_found
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/layers_test.py --self-test)
  add_test(NAME one_way.systems_and_libraries_are_asked_in_one_place
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/one_way_test.py ${PROJECT_SOURCE_DIR})
  add_test(NAME one_way.faults_are_found
    COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/one_way_test.py --self-test)
  set_tests_properties(one_way.systems_and_libraries_are_asked_in_one_place one_way.faults_are_found PROPERTIES LABELS unit TIMEOUT 60)
  find_program(EQUIPOISE_CLANG_TIDY clang-tidy)
  if(EQUIPOISE_CLANG_TIDY)
    add_test(NAME tidy.finds_nothing_of_its_list
      COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/tidy_test.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR})
    set_tests_properties(tidy.finds_nothing_of_its_list PROPERTIES LABELS tidy TIMEOUT 600)
  else()
    message(STATUS "clang-tidy not found: its test is left out")
  endif()
  add_test(NAME studies.of_the_paper_are_as_generated
    COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/studies/paper/generate.py --check)
  add_test(NAME docs.sentences_name_tests_that_exist
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/sentences_doc_test.py ${PROJECT_SOURCE_DIR})
  add_test(NAME docs.way_of_a_start_is_where_it_says
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/way_of_a_start_test.py ${PROJECT_SOURCE_DIR})
  set_tests_properties(layers.include_leftwards_only layers.faults_are_found studies.of_the_paper_are_as_generated
    docs.sentences_name_tests_that_exist docs.way_of_a_start_is_where_it_says
    PROPERTIES LABELS unit TIMEOUT 60)
  # The same sources: whether all of them are built (of folders that are meant to build all).
  if(EQUIPOISE_BUILD_PROGRAM AND EQUIPOISE_BUILD_PYTHON AND EQUIPOISE_BUILD_BENCHMARKS AND CMAKE_GENERATOR STREQUAL "Ninja")
    add_test(NAME build.misses_are_found
      COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/built_test.py --self-test ${PROJECT_BINARY_DIR})
    set_tests_properties(build.misses_are_found PROPERTIES LABELS unit TIMEOUT 60)
    set(whole_build ${PROJECT_BINARY_DIR})
  endif()
  add_test(NAME build.leaves_nothing_out
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/built_test.py ${PROJECT_SOURCE_DIR} ${whole_build})
  set_tests_properties(build.leaves_nothing_out PROPERTIES LABELS unit TIMEOUT 60)
else()
  message(STATUS "Python 3 not found: the checks of layers, of generated studies and of builds are left out")
endif()

# The fuzz target, with libFuzzer where asked for and with a driver of our own everywhere else. Both run a bounded,
# seeded number of inputs as a test; for a longer search run the program by hand.
add_executable(study_fuzz fuzz/study_fuzz.cpp)
add_dependencies(equipoise_tests study_fuzz)
target_compile_options(study_fuzz PRIVATE -Wall -Wextra)
set(seeds ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/seeds ${PROJECT_SOURCE_DIR}/studies)
set(dictionary ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/study.dict)
if(EQUIPOISE_BUILD_FUZZER)
  # The reader, and with it toml++ and fmt as headers, is compiled into the target with coverage: so the search sees
  # into all three, and nothing else of the library has to be instrumented.
  set(library ${PROJECT_SOURCE_DIR}/src/equipoise)
  file(GLOB reader CONFIGURE_DEPENDS ${library}/study/*.cpp)
  target_sources(study_fuzz PRIVATE ${reader} ${library}/base/display_text.cpp ${library}/base/error.cpp ${library}/base/read_number.cpp ${library}/model/speed.cpp
    ${library}/statistics/distributions.cpp)
  target_include_directories(study_fuzz PRIVATE ${PROJECT_SOURCE_DIR}/src
    $<TARGET_PROPERTY:tomlplusplus::tomlplusplus,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(study_fuzz PRIVATE fmt::fmt-header-only)
  target_compile_options(study_fuzz PRIVATE -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=undefined)
  target_link_options(study_fuzz PRIVATE -fsanitize=fuzzer,address,undefined)
  set(corpus ${CMAKE_CURRENT_BINARY_DIR}/study_corpus)  # new inputs go here; the seeds are only read
  file(MAKE_DIRECTORY ${corpus})
  add_test(NAME study_fuzz
    COMMAND study_fuzz -runs=20000 -seed=1 -max_len=4096 -dict=${dictionary} ${corpus} ${seeds})
else()
  target_sources(study_fuzz PRIVATE fuzz/fuzz_driver.cpp)
  target_link_libraries(study_fuzz PRIVATE equipoise)
  add_test(NAME study_fuzz COMMAND study_fuzz --inputs 20000 --seed 1 --dictionary ${dictionary} ${seeds})
endif()
set_tests_properties(study_fuzz PROPERTIES LABELS fuzz TIMEOUT ${longest_test})
