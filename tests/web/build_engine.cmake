# Builds the browser's engine (preset web). cmake -DSOURCE=... -P build_engine.cmake
foreach(arguments "--preset;web" "--build;--preset;web")
  execute_process(COMMAND ${CMAKE_COMMAND} ${arguments} WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "cmake ${arguments}: ${failed}")
  endif()
endforeach()
