# Builds the browser's page around the engine. cmake -DSOURCE=... -DNPM=... -P build_page.cmake
# Its tools come from npm's registry; where that is out of reach there is no page to test.
if(NOT EXISTS ${SOURCE}/web/node_modules/.package-lock.json)
  execute_process(COMMAND ${NPM} ci --no-audit --no-fund --fetch-retries 1 WORKING_DIRECTORY ${SOURCE}/web RESULT_VARIABLE failed)
  if(failed)
    message("skipped: the page's packages could not be fetched")
    return()
  endif()
endif()
execute_process(COMMAND ${NPM} run build WORKING_DIRECTORY ${SOURCE}/web RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "npm run build: ${failed}")
endif()
