// Rejects headers of classic NetCDF files at which the C library (4.9) takes all memory, loops or crashes.
#pragma once

#include <string>

namespace equipoise::io {

/// Why a file's header contradicts itself or the file's length; empty if the library may read it. Formats 1, 2 and 5 of
/// the NetCDF classic format specification (docs.unidata.ucar.edu/netcdf-c/current/file_format_specifications.html).
std::string netcdf_fault(const std::string& path);

}  // namespace equipoise::io
