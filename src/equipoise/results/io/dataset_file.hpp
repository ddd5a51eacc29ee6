// The one writer of NetCDF: a file that holds a Dataset.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "equipoise/results/columns/dataset.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/replacement.hpp"

namespace equipoise::io {

int netcdf_type(DataColumn::Type type);

/// A new file, which finish() seals (sealed_file.hpp) and puts in the place of `path`. Throws RunError, with an old
/// file as it was.
class DatasetFile {
 public:
  DatasetFile(const std::string& path, const Dataset& data);

  /// Of a column whose values are not known: rows along its first dimension.
  void write_rows(std::size_t column, std::size_t first, std::size_t rows, const double* numbers);
  /// Writes the values that are known, as they are now.
  void finish();

 private:
  void write_known(std::size_t column);

  std::string path_;
  const Dataset& data_;
  Replacement place_;
  NetcdfFile file_;
  std::vector<int> variables_;  ///< of the columns
};

inline void write_netcdf_file(const std::string& path, const Dataset& data) { DatasetFile(path, data).finish(); }

}  // namespace equipoise::io
