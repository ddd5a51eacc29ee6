# Debian's package of SUNDIALS asks for OpenMP. Nothing here uses it, and Clang's OpenMP and GCC's exclude each other
# there: where none is found an empty target stands for it.
find_package(OpenMP QUIET)
if(NOT OpenMP_FOUND AND NOT TARGET OpenMP::OpenMP_C)
  add_library(OpenMP::OpenMP_C INTERFACE IMPORTED GLOBAL)
endif()
