# The chart library that reports carry: plotly.js, MIT licence, from the npm package plotly.js-basic-dist-min. ./dev puts
# it where this looks first. Without it reports show pictures only.
set(plotly_version 4.1.1)
set(plotly_sha256 99784e3abfb07b142a15e521a439e6d9addceadb3f79553fd24c72774f0649ba)
find_file(EQUIPOISE_PLOTLY plotly-basic.min.js
  PATHS ${PROJECT_SOURCE_DIR}/build/npm/node_modules/plotly.js-basic-dist-min NO_DEFAULT_PATH
  DOC "plotly-basic.min.js ${plotly_version}, embedded into reports")
if(EQUIPOISE_PLOTLY)
  file(SHA256 ${EQUIPOISE_PLOTLY} found_sha256)
  if(NOT found_sha256 STREQUAL plotly_sha256)
    message(WARNING "${EQUIPOISE_PLOTLY} is not plotly.js-basic-dist-min ${plotly_version}: reports show pictures only")
    set(EQUIPOISE_PLOTLY "")
  endif()
else()
  message(STATUS "plotly.js not found: reports show pictures only")
  set(EQUIPOISE_PLOTLY "")
endif()
