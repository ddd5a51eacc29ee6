# Warnings as errors, with the compilers that continuous integration has: Debian 12's GCC 12, and its Emscripten for the
# browser. Another compiler may know more warnings, which must not stop anyone from building. Presets switch this on; a
# plain cmake, a package and an outside project that adds this one as a subdirectory do not.
option(EQUIPOISE_WERROR "Treat warnings as errors (GCC 12, Emscripten)" OFF)
if(EQUIPOISE_WERROR)
  if(EMSCRIPTEN)
    add_compile_options(-Werror)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
    # It takes "literal" + string for a copy between places that overlap (GCC's bug 105651).
    add_compile_options(-Werror -Wno-restrict)
  else()
    message(STATUS "Warnings are no errors: ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} is not GCC 12")
  endif()
endif()
