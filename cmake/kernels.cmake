# Which instruction sets the kernels are compiled for, and how: equipoise_kernel_definitions for every source that Highway's
# foreach_target compiles anew for each, equipoise_kernel_contraction for what compilers may fuse. Portable code ("scalar")
# is always among them, and the best that a machine has is chosen at run time.
set(EQUIPOISE_KERNELS all CACHE STRING
  "Instruction sets of the kernels beside portable code: all (packages), native (this machine's best: builds in half the \
time), or some of AVX-512, AVX2, SSE4, NEON, scalar, separated by semicolons")

# By the names that --cpu knows, best first, and Highway's for them. All that it has besides, in this release or a later one,
# is left out: nothing in it makes these kernels faster (SSSE3, later sets of AVX-512), or its registers have no size that is
# known to the compiler (SVE). Highway's own NEON asks for AES, which some processors lack: since 1.0.4 it can do without.
set(kernel_names AVX-512 AVX2 SSE4 NEON)
set(kernel_targets HWY_AVX3 HWY_AVX2 HWY_SSE4 HWY_NEON)
if(HWY_VERSION VERSION_GREATER_EQUAL 1.0.4)
  list(TRANSFORM kernel_targets REPLACE "^HWY_NEON$" HWY_NEON_WITHOUT_AES)
endif()

set(wanted ${EQUIPOISE_KERNELS})
if(EQUIPOISE_SANITIZE)
  # Fully instrumented, the inlined kernels of every target take half an hour to compile. What sanitizers look for does
  # not depend on the target: one wide one and the portable one are kept.
  set(wanted AVX2 NEON)
elseif(wanted STREQUAL native AND CMAKE_CROSSCOMPILING)
  set(wanted all)
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
set(kept HWY_SCALAR)
if(wanted STREQUAL all)
  list(APPEND kept ${kernel_targets})
else()
  foreach(name IN LISTS wanted)
    if(NOT name IN_LIST kernel_names AND NOT name STREQUAL scalar)
      message(FATAL_ERROR "EQUIPOISE_KERNELS: \"${name}\" is none of all, native, ${kernel_names}, scalar")
    endif()
  endforeach()
  foreach(name target IN ZIP_LISTS kernel_names kernel_targets)
    if(name IN_LIST wanted)
      list(APPEND kept ${target})
    endif()
  endforeach()
endif()
list(JOIN wanted ", " wanted)
message(STATUS "Kernels: ${wanted} (Highway ${HWY_VERSION})")
list(JOIN kept "|" kept)
# Highway leaves portable code out where a compiler may use more anyway, and has two kinds of it, chosen by the compiler's
# version. Here it is always compiled, and always HWY_SCALAR.
set(equipoise_kernel_definitions HWY_COMPILE_ALL_ATTAINABLE HWY_BROKEN_EMU128=1 "HWY_DISABLED_TARGETS=(~(${kept}))")

# Everything else is portable code too, called from anywhere: a compiler that may use NEON or SSE2 everywhere does not have
# Highway turn to them there.
set(equipoise_portable_definitions HWY_BASELINE_TARGETS=HWY_SCALAR)

# Fused multiply-adds beyond those that are written: compilers choose differently which of two products they fuse. GCC on
# x86 may (its results are on record); elsewhere the source alone decides, so that compilers and processors agree.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64)$")
  set(equipoise_kernel_contraction fast)
else()
  set(equipoise_kernel_contraction off)
endif()
