// A Dataset as NetCDF: definitions in its order, then values, some rows at a time.
#include "equipoise/results/io/dataset_file.hpp"

#include <algorithm>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/replacement.hpp"

namespace equipoise::io {

namespace {

constexpr std::size_t values_at_once = std::size_t{1} << 19;
// Any reader knows variables of up to 2 GiB.
constexpr std::size_t most_bytes = (std::size_t{1} << 31) - 4;

std::vector<std::size_t> shape_of(const DataColumn& column, const Dataset& data) {
  std::vector<std::size_t> shape;
  for (const std::size_t along : column.along) shape.push_back(data.dimensions[along].length);
  return shape;
}

std::size_t product(const std::vector<std::size_t>& lengths, std::size_t from) {
  return std::accumulate(lengths.begin() + std::min(from, lengths.size()), lengths.end(), std::size_t{1},
                         std::multiplies<>());
}

int define(NetcdfFile& file, const DataColumn& column, const std::vector<int>& dimensions) {
  std::vector<int> along;
  for (const std::size_t place : column.along) along.push_back(dimensions[place]);
  const int variable = file.variable(column.name, netcdf_type(column.type), along, column.units, column.long_name);
  with_type(column.type, [&]<class T>(T fill) {
    if (!column.fill) return;
    fill = static_cast<T>(*column.fill);
    file.fill(variable, &fill);
  });
  if (!column.flags.empty()) file.attribute(variable, "flag_values", netcdf_type(column.type), column.flags);
  for (const auto& [name, text] : column.attributes) file.attribute(variable, name, text);
  return variable;
}

NetcdfFile::Mode mode_for(const Dataset& data) {
  bool large = false;
  for (const DataColumn& c : data.columns)
    with_type(c.type, [&]<class T>(T) { large = large || product(shape_of(c, data), 0) > most_bytes / sizeof(T); });
  return large ? NetcdfFile::Mode::create_large : NetcdfFile::Mode::create;
}

void write_values(NetcdfFile& file, int variable, const DataColumn& column, const std::vector<std::size_t>& shape) {
  const std::size_t width = product(shape, 1), rows = shape.empty() ? 1 : shape.front();
  const std::size_t at_once = std::max<std::size_t>(values_at_once / std::max<std::size_t>(width, 1), 1);
  std::vector<std::size_t> start(shape.size(), 0), count = shape;
  std::vector<double> numbers;
  for (std::size_t first = 0; first < rows; first += at_once) {
    const std::size_t there = std::min(at_once, rows - first);
    if (!shape.empty()) start.front() = first, count.front() = there;
    numbers.resize(there * width);
    column.values.read(first * width, numbers.size(), numbers.data());
    with_type(column.type, [&]<class T>(T) {
      std::vector<T> values(numbers.size());
      std::transform(numbers.begin(), numbers.end(), values.begin(), [](double v) { return static_cast<T>(v); });
      file.write(variable, start, count, values.data());
    });
  }
}

}  // namespace

void write_netcdf_file(const std::string& path, const Dataset& data) {
  if (const std::string problem = why_no_results_at(path); !problem.empty())
    throw RunError(fmt::format("{}: cannot be written: {}", path, problem));
  Replacement place(path);
  NetcdfFile file(place.file(), mode_for(data), path);
  std::vector<int> dimensions, variables;
  for (const auto& [name, length] : data.dimensions) dimensions.push_back(file.dimension(name, length));
  for (const DataColumn& c : data.columns) variables.push_back(define(file, c, dimensions));
  for (const auto& [name, text] : data.attributes) file.attribute(name, text);
  if (!data.filled) file.leave_unfilled();
  file.end_definitions();
  for (std::size_t k = 0; k < variables.size(); ++k)
    if (const DataColumn& c = data.columns[k]; c.values.known()) write_values(file, variables[k], c, shape_of(c, data));
  file.close();
  seal(place.file(), path);
  place.commit();
}

std::vector<double> read_column(const NetcdfFile& file, const std::string& name, DataColumn::Type type,
                                const std::vector<std::size_t>& shape) {
  const int variable = file.variable(name, netcdf_type(type), shape);
  std::vector<double> numbers;
  with_type(type, [&]<class T>(T) {
    std::vector<T> values(product(shape, 0));
    if (!values.empty()) file.read(variable, std::vector<std::size_t>(shape.size(), 0), shape, values.data());
    numbers.assign(values.begin(), values.end());
  });
  return numbers;
}

}  // namespace equipoise::io
