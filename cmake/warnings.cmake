# Warnings as errors, with the compilers that continuous integration has: Debian 12's GCC 12, its newest Clang, and its
# Emscripten for the browser. Another compiler may know more warnings, which must not stop anyone from building. Presets switch this on; a
# plain cmake, a package and an outside project that adds this one as a subdirectory do not.
option(EQUIPOISE_WERROR "Treat warnings as errors (GCC 12, Clang 22, Emscripten)" OFF)
if(EQUIPOISE_WERROR)
  if(EMSCRIPTEN)
    add_compile_options(-Werror)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
    # It takes "literal" + string for a copy between places that overlap (GCC's bug 105651).
    add_compile_options(-Werror -Wno-restrict)
  elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^22\\.")
    # It warns of what the standard library of GCC 12 does within std::stable_sort.
    add_compile_options(-Werror -Wno-deprecated-declarations)
  else()
    message(STATUS "Warnings are no errors: ${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} is neither GCC 12 nor Clang 22")
  endif()
endif()
