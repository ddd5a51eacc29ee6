// The equations of motion of a study, vectorised over arrays of states.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"
#include "py_study.hpp"
#include "starts.hpp"

namespace equipoise::python {

namespace {

using States = py::array_t<double, py::array::c_style | py::array::forcecast>;

// Of an array of states (..., dimension): what the dimensions before the last come to.
std::size_t states_in(const StudyEquations& equations, const States& states) {
  const auto width = static_cast<py::ssize_t>(equations.dimension());
  if (states.ndim() == 0 || states.shape(states.ndim() - 1) != width)
    throw InputError("state", "",
                     states.ndim() == 0 ? "a single number" : std::to_string(states.shape(states.ndim() - 1)),
                     "must be an array of shape (..., " + std::to_string(width) + ")");
  return static_cast<std::size_t>(states.size() / width);
}

// One time, or one a state.
class Times {
 public:
  Times(const States& times, std::size_t states) : data_(times.data()), one_(times.size() == 1) {
    if (!one_ && static_cast<std::size_t>(times.size()) != states)
      throw InputError("t", "", std::to_string(times.size()) + " times",
                       "must be one time, or one for each of " + std::to_string(states) + " states");
  }
  double operator[](std::size_t i) const { return one_ ? *data_ : data_[i]; }

 private:
  const double* data_;
  bool one_;
};

std::vector<py::ssize_t> outer_shape(const States& states) {
  return {states.shape(), states.shape() + states.ndim() - 1};
}

std::size_t piece_of(const StudyEquations& equations, std::optional<std::size_t> piece, double t) {
  if (!piece) return equations.piece_at(t);
  if (*piece >= equations.pieces().size())
    throw InputError("piece", "", std::to_string(*piece),
                     "must be less than the number of pieces, " + std::to_string(equations.pieces().size()));
  return *piece;
}

// compute(piece, t, y, out) for every state, `numbers` of them into `out` each.
template <class Compute>
py::array_t<double> for_each(const StudyEquations& e, const States& times, const States& states,
                             std::optional<std::size_t> piece, const std::vector<py::ssize_t>& more, Compute compute) {
  const std::size_t count = states_in(e, states), width = static_cast<std::size_t>(e.dimension());
  const Times t(times, count);
  std::vector<py::ssize_t> shape = outer_shape(states);
  std::size_t numbers = 1;
  for (const py::ssize_t side : more) {
    shape.push_back(side);
    numbers *= static_cast<std::size_t>(side);
  }
  py::array_t<double> result(shape);
  double* out = result.mutable_data();
  const double* y = states.data();
  const py::gil_scoped_release unlocked;
  for (std::size_t i = 0; i < count; ++i) compute(piece_of(e, piece, t[i]), t[i], y + i * width, out + i * numbers);
  return result;
}

using Piece = std::optional<std::size_t>;

py::array_t<double> rhs(const StudyEquations& e, const States& t, const States& y, Piece piece) {
  return for_each(e, t, y, piece, {e.dimension()},
                  [&](std::size_t p, double at, const double* state, double* out) { e.rhs(p, at, state, out); });
}

py::array_t<double> jacobian(const StudyEquations& e, const States& t, const States& y, Piece piece) {
  return for_each(e, t, y, piece, {e.dimension(), e.dimension()},
                  [&](std::size_t p, double at, const double* state, double* out) { e.jacobian(p, at, state, out); });
}

py::array_t<double> energy(const StudyEquations& e, const States& t, const States& y, Piece piece) {
  return for_each(e, t, y, piece, {},
                  [&](std::size_t p, double at, const double* state, double* out) { *out = e.energy(p, at, state); });
}

// drive, supports, balls.
py::array_t<double> powers(const StudyEquations& e, const States& t, const States& y, Piece piece) {
  return for_each(e, t, y, piece, {3}, [&](std::size_t p, double at, const double* state, double* out) {
    const model::Powers powers = e.powers(p, at, state);
    out[0] = powers.drive;
    out[1] = powers.supports;
    out[2] = powers.balls;
  });
}

// As a trajectory tells it: x, y, x_dot, y_dot, angles, rates, psi, psi_dot.
py::array_t<double> motion(const StudyEquations& e, const States& t, const States& y, Piece piece) {
  const int balls = e.study().parameters.balls;
  return for_each(e, t, y, piece, {6 + 2 * balls}, [&](std::size_t p, double at, const double* state, double* out) {
    const MotionState m = e.motion(p, at, state);
    for (const double number : {m.x, m.y, m.x_dot, m.y_dot}) *out++ = number;
    for (int i = 0; i < balls; ++i) *out++ = m.phi[static_cast<std::size_t>(i)];
    for (int i = 0; i < balls; ++i) *out++ = m.phi_dot[static_cast<std::size_t>(i)];
    *out++ = m.psi;
    *out = m.psi_dot;
  });
}

py::array_t<double> cross(const StudyEquations& e, std::size_t piece, const States& state) {
  if (states_in(e, state) != 1) throw InputError("state", "", "", "must be one state");
  std::vector<double> y(state.data(), state.data() + e.dimension());
  e.cross(piece_of(e, piece, 0.0), y.data());
  return array_of(std::move(y));
}

py::list components(const StudyEquations& e) {
  py::list list;
  for (const model::StateVariable& c : e.variables()) list.append(py::make_tuple(c.name, c.unit, c.long_name, c.angle));
  return list;
}

py::list pieces(const StudyEquations& e) {
  py::list list;
  for (const StudyEquations::Piece& p : e.pieces()) list.append(py::make_tuple(p.begin, p.end, p.held));
  return list;
}

py::array_t<double> initial_states(const StudyEquations& e, const std::optional<py::array>& starts) {
  if (!starts) return array_of(e.initial_state());
  std::vector<double> states;
  const std::vector<InitialState> given = starts_from(e.study(), *starts, "starts");
  for (const InitialState& start : given)
    for (const double number : e.initial_state(start)) states.push_back(number);
  return array_of(std::move(states), {static_cast<py::ssize_t>(given.size()), e.dimension()});
}

}  // namespace

void bind_equations(py::module_& module) {
  py::class_<StudyEquations>(module, "Equations")
      .def(py::init([](const PyStudy& s) { return StudyEquations(s.study); }), py::arg("study"))
      .def_property_readonly("dimension", &StudyEquations::dimension)
      .def_property_readonly("components", &components)
      .def_property_readonly("pieces", &pieces)
      .def_property_readonly("breakpoints", &StudyEquations::breakpoints)
      .def_property_readonly("release_time", &StudyEquations::release_time)
      .def_property_readonly("release_speed", &StudyEquations::release_speed)
      .def("release_distance",
           [](const StudyEquations& e, const States& y) {
             if (states_in(e, y) != 1) throw InputError("state", "", "", "must be one state");
             return e.release_distance(y.data());
           })
      .def("released_at", &StudyEquations::released_at, py::arg("t"))
      .def("initial_states", &initial_states, py::arg("starts") = py::none())
      .def("rhs", &rhs)
      .def("jacobian", &jacobian)
      .def("energy", &energy)
      .def("powers", &powers)
      .def("motion", &motion)
      .def("cross", &cross);
}

}  // namespace equipoise::python
