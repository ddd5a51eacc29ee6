# One shared library of everything, from the objects that the static ones are made of: nothing is compiled twice. It shows
# what the installed headers declare and hides all else, so the program, the Python package and the tests, which use what
# is inside, link the static libraries.
if(NOT UNIX OR APPLE OR EMSCRIPTEN)
  message(FATAL_ERROR "EQUIPOISE_SHARED: the shared library is made with a version script, which this linker does not know")
endif()
set(exported_map ${PROJECT_BINARY_DIR}/src/equipoise/exported.map)
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)

add_library(equipoise_shared SHARED
  $<TARGET_OBJECTS:equipoise> $<TARGET_OBJECTS:equipoise_cold> $<TARGET_OBJECTS:equipoise_paper> ${exported_map})
foreach(property INCLUDE_DIRECTORIES COMPILE_FEATURES)
  get_target_property(value equipoise INTERFACE_${property})
  set_target_properties(equipoise_shared PROPERTIES INTERFACE_${property} "${value}")
endforeach()
get_target_property(used equipoise LINK_LIBRARIES)
target_link_libraries(equipoise_shared PRIVATE ${used} INTERFACE Eigen3::Eigen)

# While the first number of the version is 0, its second one breaks what was; afterwards the first alone does.
set(interface ${PROJECT_VERSION_MAJOR})
if(interface EQUAL 0)
  set(interface 0.${PROJECT_VERSION_MINOR})
endif()
set_target_properties(equipoise_shared PROPERTIES OUTPUT_NAME equipoise EXPORT_NAME equipoise LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION} SOVERSION ${interface} LINK_DEPENDS ${exported_map})

set(headers ${public_header_files} ${PROJECT_BINARY_DIR}/src/equipoise/include/equipoise/core/base/version.hpp)
add_custom_command(OUTPUT ${exported_map}
  COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.py ${exported_map}
    EQUIPOISE_${interface} ${CMAKE_NM} ${headers} -- $<TARGET_FILE:equipoise> $<TARGET_FILE:equipoise_paper>
  DEPENDS ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.py ${headers} equipoise equipoise_paper
  COMMENT "Listing what the shared library shows" VERBATIM)
target_link_options(equipoise_shared PRIVATE
  -Wl,--version-script=${exported_map} -Wl,-z,defs -Wl,--as-needed)

# The paper is in the same file.
add_library(equipoise_shared_paper INTERFACE)
set_target_properties(equipoise_shared_paper PROPERTIES EXPORT_NAME paper)
target_link_libraries(equipoise_shared_paper INTERFACE equipoise_shared)
