# What other projects link, and what is installed: find_package(equipoise) gives the same names as add_subdirectory.
# Components of an installation: program, library (a shared one), development.
include(CMakePackageConfigHelpers)

# The public interface: equipoise/equipoise.hpp and equipoise/paper.hpp, and all that they include. It is installed, and
# what it declares is what the shared library shows. Templates and kernels stay inside.
set(equipoise_public_headers "")
set(to_read equipoise.hpp paper.hpp)
while(to_read)
  list(POP_FRONT to_read header)
  list(APPEND equipoise_public_headers ${header})
  file(STRINGS ${PROJECT_SOURCE_DIR}/src/equipoise/${header} included REGEX "^#include \"equipoise/")
  list(TRANSFORM included REPLACE "^#include \"equipoise/([^\"]+)\".*$" "\\1")
  list(APPEND to_read ${included})
  list(REMOVE_DUPLICATES to_read)
  list(REMOVE_ITEM to_read ${equipoise_public_headers} core/base/version.hpp)  # The version's header is made by the build.
endwhile()
list(TRANSFORM equipoise_public_headers PREPEND ${PROJECT_SOURCE_DIR}/src/equipoise/ OUTPUT_VARIABLE public_header_files)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${public_header_files})

if(EQUIPOISE_SHARED)
  include(cmake/shared.cmake)
  set(libraries equipoise_shared equipoise_shared_paper)
else()
  set(libraries equipoise equipoise_paper)
  set_target_properties(equipoise_paper PROPERTIES EXPORT_NAME paper)
endif()
list(GET libraries 0 library)
list(GET libraries 1 paper)
add_library(equipoise::equipoise ALIAS ${library})
add_library(equipoise::paper ALIAS ${paper})

if(NOT EQUIPOISE_INSTALL)
  return()
endif()

set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/equipoise)
install(TARGETS ${libraries} EXPORT equipoise_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
foreach(header IN LISTS equipoise_public_headers)
  get_filename_component(folder ${header} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/equipoise/${header}
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/equipoise/${folder} COMPONENT development)
endforeach()
install(FILES ${PROJECT_BINARY_DIR}/src/equipoise/include/equipoise/core/base/version.hpp
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/equipoise/core/base COMPONENT development)

# For CMake. While the first number of the version is 0, its second one breaks what was; afterwards the first alone does.
set(compatible SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(compatible SameMinorVersion)
endif()
install(EXPORT equipoise_targets NAMESPACE equipoise:: DESTINATION ${config_dir} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/equipoise-config.cmake.in
  ${PROJECT_BINARY_DIR}/equipoise-config.cmake INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/equipoise-config-version.cmake COMPATIBILITY ${compatible})
set(config_files ${PROJECT_BINARY_DIR}/equipoise-config.cmake ${PROJECT_BINARY_DIR}/equipoise-config-version.cmake)
install(FILES ${config_files} DESTINATION ${config_dir} COMPONENT development)

# For all else: pkg-config. A static library names what it needs.
set(pkg_config_libraries -lequipoise)
set(pkg_config_requires eigen3)
if(NOT EQUIPOISE_SHARED)
  set(pkg_config_libraries "-lequipoise_paper -lequipoise -pthread")
  string(APPEND pkg_config_requires ", tbb, fmt, tomlplusplus, libpng, libhwy, netcdf")
  if(EQUIPOISE_PAGMO)
    string(APPEND pkg_config_libraries " -lpagmo -lboost_serialization")
  endif()
endif()
set(pkg_config_prefix ${CMAKE_INSTALL_PREFIX})
if(NOT CMAKE_INSTALL_PREFIX STREQUAL /usr)  # may be moved
  file(RELATIVE_PATH up /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  set(pkg_config_prefix "\${pcfiledir}/${up}")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/equipoise.pc.in ${PROJECT_BINARY_DIR}/equipoise.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/equipoise.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

if(EQUIPOISE_BUILD_PROGRAM)
  include(cmake/install_program.cmake)
endif()
