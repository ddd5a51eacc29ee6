// Values between Python and the library.
#include "convert.hpp"

#include <cmath>
#include <cstdint>

#include "equipoise/core/base/error.hpp"

namespace equipoise::python {

namespace {

std::string type_name(const py::handle& object) { return py::str(py::type::of(object).attr("__name__")); }

StudyValue table_from(const py::dict& dictionary) {
  StudyValue table;
  for (const auto& [key, value] : dictionary) table.set(py::str(key), value_from(value));
  return table;
}

StudyValue whole_from(const py::handle& object) {
  int overflow = 0;
  const long long value = PyLong_AsLongLongAndOverflow(object.ptr(), &overflow);
  if (overflow != 0) return StudyValue::Other{"too large a number", py::str(object)};
  return static_cast<std::int64_t>(value);
}

}  // namespace

StudyValue value_from(const py::handle& object) {
  if (py::isinstance<py::bool_>(object)) return object.cast<bool>();
  if (py::isinstance<py::int_>(object)) return whole_from(object);
  if (py::isinstance<py::float_>(object)) return object.cast<double>();
  if (py::isinstance<py::str>(object)) return object.cast<std::string>();
  if (py::isinstance<py::dict>(object)) return table_from(py::reinterpret_borrow<py::dict>(object));
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object)) {
    StudyValue::Array entries;
    for (const py::handle& entry : object) entries.push_back(value_from(entry));
    return entries;
  }
  return StudyValue::Other{"a value of type " + type_name(object), py::repr(object)};
}

py::object to_python(const StudyValue& value) {
  if (const auto* truth = value.boolean()) return py::bool_(*truth);
  if (const auto* whole = value.integer()) return py::int_(*whole);
  if (const auto* number = value.real()) return py::float_(*number);
  if (const auto* text = value.string()) return py::str(*text);
  if (const auto* other = value.other()) return py::str(other->text);
  if (const auto* array = value.array()) {
    py::list entries;
    for (const StudyValue& entry : *array) entries.append(to_python(entry));
    return entries;
  }
  py::dict table;
  for (const auto& [key, member] : *value.table()) table[py::str(key)] = to_python(member);
  return table;
}

std::vector<std::vector<double>> rows_from(const py::array& array, std::size_t width, const std::string& argument,
                                           const std::string& meaning) {
  const auto refuse = [&](const std::string& wrong) {
    throw InputError(argument, "", wrong,
                     "must be an array of shape (n, " + std::to_string(width) + ") of finite numbers: " + meaning);
  };
  if (array.ndim() != 2 || static_cast<std::size_t>(array.shape(1)) != width)
    refuse("shape " + std::string(py::str(array.attr("shape"))));
  if (const char kind = array.dtype().kind(); kind != 'f' && kind != 'i' && kind != 'u')
    refuse("dtype " + std::string(py::str(array.dtype())));
  const auto numbers = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(array);
  if (!numbers) throw py::error_already_set();
  const double* data = numbers.data();
  std::vector<std::vector<double>> rows(static_cast<std::size_t>(array.shape(0)));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].assign(data + i * width, data + (i + 1) * width);
    for (const double number : rows[i])
      if (!std::isfinite(number)) refuse("row " + std::to_string(i) + " holds " + std::to_string(number));
  }
  return rows;
}

std::vector<InitialState> starts_from(const Study& study, const py::array& array, const std::string& argument) {
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  const std::string widths = std::to_string(balls) + " (ball angles) or " + std::to_string(4 + 2 * balls) +
                             " (x, y, x_dot, y_dot, ball angles, ball rates)";
  const std::size_t width = array.ndim() == 2 ? static_cast<std::size_t>(array.shape(1)) : 0;
  const bool turned = width == 5 + 2 * balls, whole = turned || width == 4 + 2 * balls;
  if (array.ndim() == 2 && width != balls && !whole)
    throw InputError(argument, "", std::to_string(width) + " numbers a row", "must be rows of " + widths);
  const auto rows = rows_from(array, whole ? width : balls, argument, widths);
  std::vector<InitialState> starts(rows.size(), study.initial);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    InitialState& start = starts[i];
    const double* row = rows[i].data();
    if (whole) {
      start.x = row[0];
      start.y = row[1];
      start.x_dot = row[2];
      start.y_dot = row[3];
      row += 4;
    }
    for (std::size_t k = 0; k < balls; ++k) {
      start.phi[k] = row[k];
      if (whole) start.phi_dot[k] = row[balls + k];
    }
    if (turned) start.psi = row[2 * balls];
  }
  return starts;
}

py::dict rotor_of(const InitialState& start) {
  py::dict rotor;
  for (const auto& [name, number] :
       {std::pair{"x", start.x}, {"y", start.y}, {"x_dot", start.x_dot}, {"y_dot", start.y_dot}, {"psi", start.psi}})
    rotor[name] = number;
  return rotor;
}

py::array_t<double> columns_of(const std::vector<std::vector<double>>& columns, std::size_t rows) {
  std::vector<double> values(rows * columns.size());
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t r = 0; r < rows; ++r) values[r * columns.size() + c] = columns[c][r];
  return array_of(std::move(values), {static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns.size())});
}

}  // namespace equipoise::python
