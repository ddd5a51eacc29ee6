# Tests of the browser's engine, where Emscripten and Node.js are: the same fates as the program, and what its calls answer.
find_program(EQUIPOISE_EMCC emcc)
find_program(EQUIPOISE_NODE node)
if(NOT EQUIPOISE_EMCC OR NOT EQUIPOISE_NODE OR NOT Python3_FOUND OR NOT EQUIPOISE_BUILD_PROGRAM OR EQUIPOISE_SANITIZE)
  message(STATUS "Tests of the browser's engine are left out: they need Emscripten, Node.js and Python 3")
  return()
endif()

# The engine has a build folder of its own. The first time takes minutes, later ones a second.
add_test(NAME web.engine_is_built
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/web/build_engine.cmake)
set_tests_properties(web.engine_is_built PROPERTIES LABELS web TIMEOUT 3600 FIXTURES_SETUP web_engine COST 400)

# web_test(NAME SCRIPT argument...)
function(web_test name script)
  add_test(NAME ${name}
    COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/web/${script} $<TARGET_FILE:equipoise_program>
      ${PROJECT_SOURCE_DIR}/build/web-engine ${EQUIPOISE_NODE} ${PROJECT_SOURCE_DIR}/studies ${ARGN})
  set_tests_properties(${name} PROPERTIES LABELS web TIMEOUT ${longest_test} FIXTURES_REQUIRED web_engine)
endfunction()
web_test(web.starts_have_the_fates_of_the_program fates_test.py --quick)
web_test(web.many_starts_have_the_fates_of_the_program fates_test.py --fused)
set_tests_properties(web.many_starts_have_the_fates_of_the_program PROPERTIES LABELS long)
web_test(web.calls_answer_as_the_program_does calls_test.py)

# The page around it, in a browser.
find_program(EQUIPOISE_NPM npm)
find_program(EQUIPOISE_CHROMIUM chromium)
execute_process(COMMAND ${EQUIPOISE_NODE} --version OUTPUT_VARIABLE node_version OUTPUT_STRIP_TRAILING_WHITESPACE)
string(REPLACE "v" "" node_version "${node_version}")
if(NOT EQUIPOISE_NPM OR NOT EQUIPOISE_CHROMIUM OR node_version VERSION_LESS 20)
  message(STATUS "Tests of the browser's page are left out: they need npm, Node.js 20 (here: ${node_version}) and Chromium")
  return()
endif()
add_test(NAME web.page_is_built
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DNPM=${EQUIPOISE_NPM}
    -P ${CMAKE_CURRENT_SOURCE_DIR}/web/build_page.cmake)
set_tests_properties(web.page_is_built PROPERTIES LABELS web TIMEOUT ${longest_test} FIXTURES_REQUIRED web_engine
  FIXTURES_SETUP web_page SKIP_REGULAR_EXPRESSION "skipped: the page's packages could not be fetched")
foreach(part answer decision study life)
  add_test(NAME web.page_${part}
    COMMAND ${EQUIPOISE_NODE} --test --test-concurrency=1 ${PROJECT_SOURCE_DIR}/web/tests/${part}.test.mjs)
  set_tests_properties(web.page_${part} PROPERTIES LABELS web TIMEOUT ${longest_test} FIXTURES_REQUIRED web_page
    ENVIRONMENT "CHROMIUM=${EQUIPOISE_CHROMIUM};EQUIPOISE_PROGRAM=$<TARGET_FILE:equipoise_program>")
endforeach()
