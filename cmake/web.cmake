# What the browser's engine is built with: header-only packages of the host, and the flags of every file.
if(NOT EMSCRIPTEN)
  message(FATAL_ERROR "EQUIPOISE_WEB needs Emscripten's toolchain file: cmake --preset web")
endif()

# The host's include folder holds its C library's headers as well, which would come before Emscripten's own: a folder of
# links holds the packages alone.
set(web_include ${PROJECT_BINARY_DIR}/packages)
file(MAKE_DIRECTORY ${web_include})
foreach(entry fmt=fmt/format.h toml++=toml++/toml.h nlohmann=nlohmann/json.hpp Random123=Random123/philox.h
    boost=boost/version.hpp Eigen=Eigen/Core)
  string(REGEX REPLACE "=.*" "" folder "${entry}")
  string(REGEX REPLACE ".*=" "" header "${entry}")
  find_path(WEB_${folder}_DIR ${header} PATHS /usr/include /usr/local/include PATH_SUFFIXES eigen3
    NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH REQUIRED)
  file(CREATE_LINK ${WEB_${folder}_DIR}/${folder} ${web_include}/${folder} SYMBOLIC)
endforeach()

add_library(equipoise_web_packages INTERFACE)
# Highway's stand-in comes with the engine.
target_include_directories(equipoise_web_packages INTERFACE ${PROJECT_SOURCE_DIR}/web/engine/simd)
target_include_directories(equipoise_web_packages SYSTEM INTERFACE ${web_include})
target_compile_definitions(equipoise_web_packages INTERFACE FMT_HEADER_ONLY TOML_HEADER_ONLY=1)
set(web_exceptions -fwasm-exceptions)
target_compile_options(equipoise_web_packages INTERFACE -msimd128 ${web_exceptions})
target_link_options(equipoise_web_packages INTERFACE -msimd128 ${web_exceptions})
