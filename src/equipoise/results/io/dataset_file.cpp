// A Dataset as NetCDF: definitions in its order, then values, some rows at a time.
#include "equipoise/results/io/dataset_file.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>

#include <netcdf.h>

#include "equipoise/results/io/sealed_file.hpp"

namespace equipoise::io {

namespace {

constexpr std::size_t values_at_once = 65536;
// Any reader knows variables of up to 2 GiB.
constexpr std::size_t most_bytes = (std::size_t{1} << 31) - 4;

// Calls visit(type as NetCDF has it, a value of that type).
template <class Visit>
void with_type(DataColumn::Type stored, const Visit& visit) {
  using Type = DataColumn::Type;
  switch (stored) {
    case Type::text:
      return visit(NC_CHAR, char{});
    case Type::byte:
      return visit(NC_BYTE, std::int8_t{});
    case Type::small:
      return visit(NC_SHORT, std::int16_t{});
    case Type::integer:
      return visit(NC_INT, int{});
    case Type::single:
      return visit(NC_FLOAT, float{});
    case Type::real:
      return visit(NC_DOUBLE, double{});
  }
}

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
  with_type(column.type, [&]<class T>(int, T fill) {
    if (!column.fill) return;
    fill = static_cast<T>(*column.fill);
    file.fill(variable, &fill);
  });
  const std::vector<int>& flags = column.flags;
  if (!flags.empty() && column.type == DataColumn::Type::byte)
    file.attribute(variable, "flag_values", std::vector<signed char>(flags.begin(), flags.end()));
  else if (!flags.empty())
    file.attribute(variable, "flag_values", std::vector<short>(flags.begin(), flags.end()));
  for (const auto& [name, text] : column.attributes) file.attribute(variable, name, text);
  return variable;
}

NetcdfFile::Mode mode_for(const Dataset& data) {
  bool large = false;
  for (const DataColumn& c : data.columns)
    with_type(c.type,
              [&]<class T>(int, T) { large = large || product(shape_of(c, data), 0) > most_bytes / sizeof(T); });
  return large ? NetcdfFile::Mode::create_large : NetcdfFile::Mode::create;
}

}  // namespace

int netcdf_type(DataColumn::Type type) {
  int there = NC_NAT;
  with_type(type, [&](int of_type, auto) { there = of_type; });
  return there;
}

DatasetFile::DatasetFile(const std::string& path, const Dataset& data)
    : path_(path), data_(data), place_(path), file_(place_.file(), mode_for(data), path) {
  std::vector<int> dimensions;
  for (const auto& [name, length] : data.dimensions) dimensions.push_back(file_.dimension(name, length));
  for (const DataColumn& c : data.columns) variables_.push_back(define(file_, c, dimensions));
  for (const auto& [name, text] : data.attributes) file_.attribute(NC_GLOBAL, name, text);
  if (!data.filled) file_.leave_unfilled();
  file_.end_definitions();
}

void DatasetFile::write_rows(std::size_t column, std::size_t first, std::size_t rows, const double* numbers) {
  std::vector<std::size_t> count = shape_of(data_.columns[column], data_), start(count.size(), 0);
  if (!count.empty()) start.front() = first, count.front() = rows;
  with_type(data_.columns[column].type, [&]<class T>(int, T) {
    std::vector<T> values(product(count, 0));
    std::transform(numbers, numbers + values.size(), values.begin(), [](double v) { return static_cast<T>(v); });
    file_.write(variables_[column], start, count, values.data());
  });
}

void DatasetFile::write_known(std::size_t column) {
  const std::vector<std::size_t> shape = shape_of(data_.columns[column], data_);
  const std::size_t width = product(shape, 1), rows = shape.empty() ? 1 : shape.front();
  const std::size_t at_once = std::max<std::size_t>(values_at_once / std::max<std::size_t>(width, 1), 1);
  std::vector<double> numbers;
  for (std::size_t first = 0; first < rows; first += at_once) {
    const std::size_t count = std::min(at_once, rows - first);
    numbers.resize(count * width);
    data_.columns[column].values.read(first * width, numbers.size(), numbers.data());
    write_rows(column, first, count, numbers.data());
  }
}

void DatasetFile::finish() {
  for (std::size_t k = 0; k < data_.columns.size(); ++k)
    if (data_.columns[k].values.known()) write_known(k);
  file_.close();
  seal(place_.file(), path_);
  place_.commit();
}

}  // namespace equipoise::io
