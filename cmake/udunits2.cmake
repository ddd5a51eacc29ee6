# UDUNITS-2 as the target UDUNITS2::UDUNITS2: it brings neither a CMake package nor a pkg-config file.
find_path(UDUNITS2_INCLUDE_DIR udunits2.h PATH_SUFFIXES udunits2)
find_library(UDUNITS2_LIBRARY udunits2)
if(NOT UDUNITS2_INCLUDE_DIR OR NOT UDUNITS2_LIBRARY)
  message(FATAL_ERROR "UDUNITS-2 not found (Debian package libudunits2-dev)")
endif()
if(NOT TARGET UDUNITS2::UDUNITS2)
  add_library(UDUNITS2::UDUNITS2 UNKNOWN IMPORTED)
  set_target_properties(UDUNITS2::UDUNITS2 PROPERTIES
    IMPORTED_LOCATION ${UDUNITS2_LIBRARY} INTERFACE_INCLUDE_DIRECTORIES ${UDUNITS2_INCLUDE_DIR})
endif()
