// The model for methods of your own: equations of motion over arrays of states, and a mapper of states to attractors.
#include <algorithm>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/simulation/trajectory/study_equations.hpp"

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

std::size_t piece_of(const StudyEquations& equations, std::optional<std::size_t> piece, double t) {
  if (!piece) return equations.piece_at(t);
  if (*piece >= equations.pieces().size())
    throw InputError("piece", "", std::to_string(*piece),
                     "must be less than the number of pieces, " + std::to_string(equations.pieces().size()));
  return *piece;
}

using Piece = std::optional<std::size_t>;

// A method over arrays of states: compute(equations, piece, t, y, out) for every one, whose result has the shape that
// `shape` says of the equations.
template <class Shape, class Compute>
auto over_states(Shape shape, Compute compute) {
  return [=](const StudyEquations& e, const States& times, const States& states, Piece piece) {
    const std::size_t count = states_in(e, states), width = static_cast<std::size_t>(e.dimension());
    const Times t(times, count);
    std::vector<py::ssize_t> whole(states.shape(), states.shape() + states.ndim() - 1);
    std::size_t numbers = 1;
    for (const int side : shape(e)) {
      whole.push_back(side);
      numbers *= static_cast<std::size_t>(side);
    }
    py::array_t<double> result(whole);
    double* out = result.mutable_data();
    const double* y = states.data();
    const py::gil_scoped_release unlocked;
    for (std::size_t i = 0; i < count; ++i)
      compute(e, piece_of(e, piece, t[i]), t[i], y + i * width, out + i * numbers);
    return result;
  };
}

// drive, supports, balls.
void powers(const StudyEquations& e, std::size_t piece, double t, const double* y, double* out) {
  const model::Powers powers = e.powers(piece, t, y);
  out[0] = powers.drive;
  out[1] = powers.supports;
  out[2] = powers.balls;
}

// As a trajectory gives it: x, y, x_dot, y_dot, angles, rates, psi, psi_dot.
void motion(const StudyEquations& e, std::size_t piece, double t, const double* y, double* out) {
  const MotionState m = e.motion(piece, t, y);
  const int balls = e.study().parameters.balls;
  for (const double number : {m.x, m.y, m.x_dot, m.y_dot}) *out++ = number;
  out = std::copy_n(m.phi.begin(), balls, out);
  out = std::copy_n(m.phi_dot.begin(), balls, out);
  *out++ = m.psi;
  *out = m.psi_dot;
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

std::unique_ptr<Mapper> make_mapper(const PyStudy& s, const py::dict& settings) {
  CallWith<MapperOptions> call(settings);
  try {
    return Call::run([&] {
      check_takes_starts(s.study);
      return std::make_unique<Mapper>(s.study, call.options);
    });
  } catch (const RunError&) {
    if (!call.interrupted()) throw;
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
}

py::dict outcomes_of(const Mapper& mapper, const py::array& states, const py::dict& settings) {
  const std::vector<InitialState> starts = starts_from(mapper.study(), states, "states");
  CallWith<> call(settings);
  std::vector<short> labels;
  for (const Outcome& outcome : Call::run([&] { return mapper(starts, call.options); }))
    labels.push_back(code_of(outcome));
  return py::dict("labels"_a = array_of(std::move(labels)), "interrupted"_a = call.interrupted());
}

py::list attractors_of(const Mapper& mapper) {
  py::list list;
  const Catalogue catalogue = mapper.attractors();
  for (const Attractor& a : catalogue.attractors()) {
    const std::vector<double> state(a.motion.state.data(), a.motion.state.data() + a.motion.state.size());
    list.append(py::make_tuple(a.id, a.name, a.alias, name_of(a.motion.kind), a.motion.stable,
                               py::make_tuple(a.motion.r_min, a.motion.r_mean, a.motion.r_max), state));
  }
  return list;
}

}  // namespace

void bind_model(py::module_& module) {
  using E = StudyEquations;
  using Shape = std::vector<int>;
  py::class_<Mapper>(module, "Mapper")
      .def(py::init(&make_mapper))
      .def("outcomes", &outcomes_of)
      .def("attractors", &attractors_of);
  py::class_<StudyEquations>(module, "Equations")
      .def(py::init([](const PyStudy& s) { return StudyEquations(s.study); }))
      .def_property_readonly("dimension", &StudyEquations::dimension)
      .def_property_readonly("components", &components)
      .def_property_readonly("pieces", &pieces)
      .def_property_readonly("breakpoints", &StudyEquations::breakpoints)
      .def_property_readonly("release_time", &StudyEquations::release_time)
      .def("released_at", &StudyEquations::released_at)
      .def("initial_states", &initial_states, py::arg("starts") = py::none())
      .def("rhs",
           over_states([](const E& e) { return Shape{e.dimension()}; }, [](const E& e, auto... at) { e.rhs(at...); }))
      .def("jacobian", over_states(
                           [](const E& e) {
                             return Shape{e.dimension(), e.dimension()};
                           },
                           [](const E& e, auto... at) { e.jacobian(at...); }))
      .def("energy",
           over_states([](const E&) { return Shape{}; }, [](const E& e, std::size_t p, double t, const double* y,
                                                            double* out) { *out = e.energy(p, t, y); }))
      .def("powers", over_states([](const E&) { return Shape{3}; }, &powers))
      .def("motion", over_states([](const E& e) { return Shape{6 + 2 * e.study().parameters.balls}; }, &motion))
      .def("cross", &cross);
}

}  // namespace equipoise::python
