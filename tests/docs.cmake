# Tests of the documentation: words and lengths of sentences, links, lessons that are run, the site that is built.
if(NOT Python3_FOUND)
  return()
endif()
add_test(NAME docs.links_lead_somewhere
  COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/docs/links_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME docs.words_and_sentences
  COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/prose_test.py ${PROJECT_SOURCE_DIR})
add_test(NAME docs.numbers_of_the_readme
  COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/docs/figures/readme_numbers.py ${PROJECT_SOURCE_DIR})
set_tests_properties(docs.links_lead_somewhere docs.words_and_sentences docs.numbers_of_the_readme PROPERTIES LABELS docs TIMEOUT 60)

set(docs_python /usr/bin/python3)  # the system's, as in python/CMakeLists.txt
if(EXISTS ${docs_python} AND EQUIPOISE_BUILD_PROGRAM AND EQUIPOISE_BUILD_PYTHON AND NOT EQUIPOISE_SANITIZE)
  set(lessons tutorials/first-machine tutorials/first-basin-python tutorials/first-cpp-program tutorials/reproduce-a-table
    how-to/hangs-at-resonance how-to/how-much-oil how-to/own-initial-states explanation/next-to-peers)
  list(TRANSFORM lessons PREPEND docs/)
  list(APPEND lessons README)
  list(TRANSFORM lessons APPEND .md)
  add_test(NAME docs.lessons_run
    COMMAND ${docs_python} -B ${CMAKE_CURRENT_SOURCE_DIR}/docs/lessons_test.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}
      ${CMAKE_CURRENT_BINARY_DIR}/lessons ${lessons})
  set_tests_properties(docs.lessons_run PROPERTIES LABELS lessons TIMEOUT ${longest_test} COST 100)

  # The site, where Sphinx and what it needs are there (./dev docs installs them).
  execute_process(COMMAND ${docs_python} -c "import sphinx, myst_parser, breathe, furo, xarray, nbconvert" RESULT_VARIABLE no_sphinx
    OUTPUT_QUIET ERROR_QUIET)
  find_program(EQUIPOISE_DOXYGEN doxygen)
  mark_as_advanced(EQUIPOISE_DOXYGEN)
  if(no_sphinx EQUAL 0 AND EQUIPOISE_DOXYGEN AND EXISTS /usr/share/javascript/katex)
    add_test(NAME docs.site
      COMMAND ${docs_python} -B ${PROJECT_SOURCE_DIR}/docs/site/build.py ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}
        ${CMAKE_CURRENT_BINARY_DIR}/site)
    set_tests_properties(docs.site PROPERTIES LABELS site TIMEOUT ${longest_test} COST 100)
  else()
    message(STATUS "Sphinx, nbconvert, Doxygen or KaTeX not found (./dev docs installs them): the documentation site is not built by the tests")
  endif()
endif()
