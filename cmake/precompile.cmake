# Headers that most files include are parsed once for all of them: half of a file's time, and more of a small one's. Files
# include what they use all the same: they compile without this too.
#
# A compiler cache cannot look into precompiled headers and would cache nothing: beside one they are off.
set(precompile ON)
if(CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache|sccache")
  set(precompile OFF)
endif()
option(EQUIPOISE_PRECOMPILE_HEADERS "Parse common headers once" ${precompile})

# equipoise_precompile(TARGET header...): those, and what of the standard library most files use.
function(equipoise_precompile target)
  if(EQUIPOISE_PRECOMPILE_HEADERS)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <complex> <cstdint> <functional> <map> <memory>
      <optional> <string> <vector> ${ARGN})
  endif()
endfunction()
