# Tests of what others get: an installed library, a part of another project's build, a Debian package.
set(outside_flags "")
if(EQUIPOISE_WERROR)
  set(outside_flags "-Wall -Wextra -Werror")
endif()
if(EQUIPOISE_SANITIZE)
  set(outside_flags "-fsanitize=address,undefined")
endif()
add_test(NAME install.outside_project_finds_and_uses_the_library
  COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR}/install
    -DEXAMPLE=${PROJECT_SOURCE_DIR}/examples/ball-mass -DSCRATCH=${CMAKE_CURRENT_BINARY_DIR}/install_scratch -DGENERATOR=${CMAKE_GENERATOR} -DCOMPILER=${CMAKE_CXX_COMPILER}
    -DFLAGS=${outside_flags} -P ${CMAKE_CURRENT_SOURCE_DIR}/install/install_test.cmake)
set_tests_properties(install.outside_project_finds_and_uses_the_library PROPERTIES LABELS outside TIMEOUT ${longest_test})

add_test(NAME install.is_a_quiet_part_of_another_build
  COMMAND ${CMAKE_COMMAND} -DROOT=${PROJECT_SOURCE_DIR} -DSCRATCH=${CMAKE_CURRENT_BINARY_DIR}/subproject_scratch
    -DGENERATOR=${CMAKE_GENERATOR} -DCOMPILER=${CMAKE_CXX_COMPILER} -P ${CMAKE_CURRENT_SOURCE_DIR}/install/subproject_test.cmake)
set_tests_properties(install.is_a_quiet_part_of_another_build PROPERTIES LABELS outside TIMEOUT ${longest_test})

if(EQUIPOISE_DEBIAN AND NOT EQUIPOISE_SANITIZE)
  find_program(EQUIPOISE_DPKG dpkg-shlibdeps)
  mark_as_advanced(EQUIPOISE_DPKG)
  if(EQUIPOISE_DPKG AND Python3_Interpreter_FOUND)
    add_test(NAME install.debian_package_of_the_program
      COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/install/package_test.py --cpack ${CMAKE_CPACK_COMMAND}
        ${PROJECT_BINARY_DIR} ${CMAKE_CURRENT_BINARY_DIR}/package_scratch)
    set_tests_properties(install.debian_package_of_the_program PROPERTIES LABELS outside TIMEOUT ${longest_test})
  endif()
endif()
