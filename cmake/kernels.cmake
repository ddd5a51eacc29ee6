# Which instruction sets the kernels are compiled for: equipoise_kernels_left_out becomes Highway's targets that they are
# not. Portable code ("scalar") is always among them, and the best that a machine has is chosen at run time.
set(EQUIPOISE_KERNELS all CACHE STRING
  "Instruction sets of the kernels beside portable code: all (packages), native (this machine's best: builds in half the \
time), or some of AVX-512, AVX2, SSE4, scalar, separated by semicolons")

# By the names that --cpu knows, best first. Highway has two targets more. Neither SSSE3 nor the extensions of AVX-512
# make these kernels faster.
set(kernel_names AVX-512 AVX2 SSE4)
set(kernel_targets HWY_AVX3 HWY_AVX2 HWY_SSE4)
set(equipoise_kernels_left_out HWY_SSSE3 HWY_AVX3_DL)

set(wanted ${EQUIPOISE_KERNELS})
if(EQUIPOISE_SANITIZE)
  # Fully instrumented, the inlined kernels of every target take half an hour to compile. What sanitizers look for does
  # not depend on the target: one wide one and the portable one are kept.
  set(wanted AVX2)
elseif(wanted STREQUAL native)
  # Asked again each time: the folder may have come to another machine.
  unset(kernels_native_ran CACHE)
  unset(kernels_native_compiled CACHE)
  try_run(kernels_native_ran kernels_native_compiled ${PROJECT_BINARY_DIR}/native_kernel
    ${CMAKE_CURRENT_LIST_DIR}/native_kernel.cpp LINK_LIBRARIES PkgConfig::HWY RUN_OUTPUT_VARIABLE wanted)
  if(NOT kernels_native_compiled OR NOT kernels_native_ran EQUAL 0)
    message(WARNING "This machine's instruction set could not be found out: kernels are built for all")
    set(wanted all)
  endif()
endif()
if(NOT wanted STREQUAL all)
  foreach(name IN LISTS wanted)
    if(NOT name IN_LIST kernel_names AND NOT name STREQUAL scalar)
      message(FATAL_ERROR "EQUIPOISE_KERNELS: \"${name}\" is none of all, native, ${kernel_names}, scalar")
    endif()
  endforeach()
  foreach(name target IN ZIP_LISTS kernel_names kernel_targets)
    if(NOT name IN_LIST wanted)
      list(APPEND equipoise_kernels_left_out ${target})
    endif()
  endforeach()
endif()
list(JOIN wanted ", " wanted)
message(STATUS "Kernels: ${wanted}")
list(JOIN equipoise_kernels_left_out "|" equipoise_kernels_left_out)
