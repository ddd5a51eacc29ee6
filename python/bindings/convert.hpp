// Values between Python and the library: trees, arrays, dictionaries, states.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "equipoise/results/columns/column.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/toml/study_value.hpp"

namespace equipoise::python {

namespace py = pybind11;

/// A tree from dictionaries, lists, numbers, strings and truth values; what else there is becomes StudyValue::Other,
/// which the reader of studies refuses by name.
StudyValue value_from(const py::handle& object);
py::object to_python(const StudyValue& value);

/// The states of `array`, one per row of `width` numbers, each finite. Throws InputError naming `argument` otherwise.
std::vector<std::vector<double>> rows_from(const py::array& array, std::size_t width, const std::string& argument,
                                           const std::string& meaning);

/// Rows of ball angles (n, balls), the rest as the study's [initial] says, or of whole states (n, 4 + 2 balls): x, y,
/// x_dot, y_dot, ball angles, ball rates in the rotating frame; one number more is the rotor's angle. Throws
/// InputError, naming `argument`, for other shapes.
std::vector<InitialState> starts_from(const Study& study, const py::array& array, const std::string& argument);

/// x, y, x_dot, y_dot, psi.
py::dict rotor_of(const InitialState& start);

/// A NumPy array that owns what the vector held; nothing is copied.
template <class T>
py::array_t<T> array_of(std::vector<T> values, std::vector<py::ssize_t> shape = {}) {
  auto owner = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = owner->data();
  if (shape.empty()) shape = {static_cast<py::ssize_t>(owner->size())};
  py::capsule keeper(owner.get(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  owner.release();
  return py::array_t<T>(std::move(shape), data, keeper);
}

/// A column as xarray and NetCDF describe it.
inline py::dict attributes_of(const Column& column) {
  return py::dict(py::arg("units") = column.cf_units(), py::arg("long_name") = column.long_name());
}

/// A table of columns, by name.
template <class Columns>
py::dict attributes_of_all(const Columns& columns) {
  py::dict all;
  for (const Column& column : columns) all[column.name] = attributes_of(column);
  return all;
}

/// Arrays of one entry a time each, as columns: (times, columns).
py::array_t<double> columns_of(const std::vector<std::vector<double>>& columns, std::size_t rows);

}  // namespace equipoise::python
