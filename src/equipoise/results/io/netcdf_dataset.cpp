// A Dataset as NetCDF: definitions in its order, then values, some rows at a time.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <numeric>

#include <netcdf.h>

#include "equipoise/results/io/netcdf.hpp"

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

void write(NetcdfFile& file, int variable, const DataColumn& column, std::vector<std::size_t> shape) {
  const std::size_t width = product(shape, 1), rows = shape.empty() ? 1 : shape.front();
  const std::size_t at_once = std::max<std::size_t>(values_at_once / std::max<std::size_t>(width, 1), 1);
  with_type(column.type, [&]<class T>(int, T) {
    std::vector<double> numbers;
    std::vector<T> values;
    std::vector<std::size_t> start(shape.size(), 0);
    for (std::size_t first = 0; first < rows; first += at_once) {
      const std::size_t end = std::min(first + at_once, rows);
      if (!shape.empty()) start.front() = first, shape.front() = end - first;
      numbers.resize((end - first) * width);
      column.values.read(first * width, numbers.size(), numbers.data());
      values.clear();
      for (const double number : numbers) values.push_back(static_cast<T>(number));
      file.write(variable, start, shape, values.data());
    }
  });
}

bool is_large(const DataColumn& column, const Dataset& data) {
  bool large = false;
  with_type(column.type, [&]<class T>(int, T) { large = product(shape_of(column, data), 0) > most_bytes / sizeof(T); });
  return large;
}

}  // namespace

int netcdf_type(DataColumn::Type type) {
  int there = NC_NAT;
  with_type(type, [&](int of_type, auto) { there = of_type; });
  return there;
}

void write_netcdf_file(const std::string& path, const Dataset& data) {
  const auto define_and_write = [&](NetcdfFile& file) {
    std::vector<int> dimensions, variables;
    for (const auto& [name, length] : data.dimensions) dimensions.push_back(file.dimension(name, length));
    for (const DataColumn& c : data.columns) variables.push_back(define(file, c, dimensions));
    for (const auto& [name, text] : data.attributes) file.attribute(NC_GLOBAL, name, text);
    if (!data.filled) file.leave_unfilled();
    file.end_definitions();
    for (std::size_t k = 0; k < variables.size(); ++k)
      if (const DataColumn& c = data.columns[k]; c.values.known()) write(file, variables[k], c, shape_of(c, data));
  };
  const bool large = std::any_of(data.columns.begin(), data.columns.end(),
                                 [&](const DataColumn& column) { return is_large(column, data); });
  write_netcdf_file(path, define_and_write, large ? NetcdfFile::Mode::create_large : NetcdfFile::Mode::create);
}

}  // namespace equipoise::io
