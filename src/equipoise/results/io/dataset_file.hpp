// The one writer of NetCDF: a file that holds a Dataset.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/io/netcdf.hpp"

namespace equipoise::io {

/// Puts a new file, sealed (replacement.hpp), in the place of `path`. Throws RunError, with what was there as it was.
void write_netcdf_file(const std::string& path, const Dataset& data);

/// All values of a column. Throws RunError unless it has this type and shape.
std::vector<double> read_column(const NetcdfFile& file, const std::string& name, DataColumn::Type type,
                                const std::vector<std::size_t>& shape);

}  // namespace equipoise::io
