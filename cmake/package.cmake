# Debian packages (./dev package): equipoise, the program; libequipoise, the shared library; libequipoise-dev, for programs
# that use it; equipoise-doc. The program has the library inside, so that one file is enough to install it. Without
# EQUIPOISE_SHARED there are only the first and the last.
if(NOT EQUIPOISE_BUILD_PROGRAM OR NOT EQUIPOISE_INSTALL)
  message(FATAL_ERROR "EQUIPOISE_DEBIAN wants EQUIPOISE_BUILD_PROGRAM and EQUIPOISE_INSTALL")
endif()
set(EQUIPOISE_CONTACT "The Equipoise developers <equipoise@localhost.invalid>" CACHE STRING "Maintainer of the packages")
set(debian_dir ${PROJECT_BINARY_DIR}/debian)
set(packages program=equipoise documentation=equipoise-doc)
if(EQUIPOISE_SHARED)
  get_target_property(interface equipoise_shared SOVERSION)
  set(library_package libequipoise${interface})
  list(APPEND packages library=${library_package} development=libequipoise-dev)
endif()

# What is built between two releases follows the last one.
set(version ${PROJECT_VERSION})
file(STRINGS CHANGELOG.md newest REGEX "^## " LIMIT_COUNT 1)
if(newest STREQUAL "## Unreleased")
  string(TIMESTAMP day "%Y%m%d" UTC)
  string(APPEND version +git${day})
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, if it is set
configure_file(packaging/debian/changelog.in ${debian_dir}/changelog @ONLY)
foreach(file ${debian_dir}/changelog=changelog.Debian ${PROJECT_SOURCE_DIR}/CHANGELOG.md=changelog)
  string(REGEX REPLACE "=.*" "" from ${file})
  string(REGEX REPLACE ".*=" "" to ${file})
  execute_process(COMMAND gzip -9nc ${from} OUTPUT_FILE ${debian_dir}/${to}.gz COMMAND_ERROR_IS_FATAL ANY)
endforeach()
set(CPACK_COMPONENTS_ALL "")
foreach(entry IN LISTS packages)
  string(REGEX REPLACE "=.*" "" component ${entry})
  string(REGEX REPLACE ".*=" "" package ${entry})
  install(FILES packaging/debian/copyright ${debian_dir}/changelog.gz ${debian_dir}/changelog.Debian.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
endforeach()
file(CREATE_LINK ../../equipoise/studies ${debian_dir}/examples SYMBOLIC)
install(FILES ${debian_dir}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/equipoise COMPONENT program)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libequipoise-dev COMPONENT development)
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/equipoise-doc COMPONENT documentation
  PATTERN site EXCLUDE PATTERN "*.py" EXCLUDE PATTERN "*.sh" EXCLUDE)
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/equipoise-doc COMPONENT documentation)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME equipoise)
set(CPACK_PACKAGE_CONTACT "${EQUIPOISE_CONTACT}")
set(CPACK_PACKAGE_VERSION ${version})
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_SOURCE_DIR}/build/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
  WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS "equipoise-doc")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
if(EQUIPOISE_SHARED)
  file(WRITE ${debian_dir}/shlibs "libequipoise ${interface} ${library_package} (>= ${PROJECT_VERSION})\n")
  file(WRITE ${debian_dir}/triggers "activate-noawait ldconfig\n")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${debian_dir}/shlibs ${debian_dir}/triggers)
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${library_package} (= ${version}-1), libeigen3-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "equipoise-doc")
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "how reliably a ball balancer balances a rotor")
set(about "Equipoise starts the balls of an automatic balancer anywhere, many thousand
times, follows every start until its fate is certain, and reports how often
each outcome happens, with a 95 % confidence interval.")
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${about}
.
This package has the program, its manual pages and studies to begin with.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "${about}
.
This package has the shared library.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${about}
.
This package has what C++ programs are compiled with: headers, files for CMake
and pkg-config, and an example.")
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "${about}
.
This package has the documentation as Markdown.")
include(CPack)
