# Checks of the house: layers, one way to each library, generated files, whether all is built.
if(NOT Python3_FOUND)
  message(STATUS "Python 3 not found: the checks of layers, of generated studies and of builds are left out")
  return()
endif()
add_test(NAME layers.hold
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
set_tests_properties(layers.hold layers.faults_are_found studies.of_the_paper_are_as_generated
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

# A package that CMake alone cannot name is asked for by Debian's name. The script stops at that, found nowhere.
add_test(NAME build.names_the_package_of_random123
  COMMAND ${CMAKE_COMMAND} -DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF -P ${PROJECT_SOURCE_DIR}/cmake/random123.cmake)
set_tests_properties(build.names_the_package_of_random123 PROPERTIES LABELS unit
  PASS_REGULAR_EXPRESSION "Random123 not found .Debian package librandom123-dev.")
