// A mapper: states to attractors.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "py_study.hpp"
#include "starts.hpp"

namespace equipoise::python {

namespace {

std::unique_ptr<Mapper> make_mapper(const PyStudy& s, const py::dict& settings) {
  Call call(settings);
  RunOptions options;
  call.set(options);
  try {
    return Call::run([&] { return std::make_unique<Mapper>(s.study, options); });
  } catch (const RunError&) {
    if (!call.interrupted()) throw;
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
}

py::dict fates_of(const Mapper& mapper, const py::array& states, const py::dict& settings) {
  const std::vector<InitialState> starts = starts_from(mapper.study(), states, "states");
  Call call(settings);
  RunOptions options;
  call.set(options);
  const std::vector<Fate> fates = Call::run([&] { return mapper(starts, options); });
  std::vector<short> labels;
  std::vector<double> times;
  for (const Fate& fate : fates) {
    labels.push_back(code_of(fate));
    times.push_back(fate.time);
  }
  py::dict result;
  result["labels"] = array_of(std::move(labels));
  result["decision_time"] = array_of(std::move(times));
  result["interrupted"] = call.interrupted();
  return result;
}

py::list known(const Mapper& mapper) {
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

void bind_mapper(py::module_& module) {
  py::class_<Mapper>(module, "Mapper")
      .def(py::init(&make_mapper), py::arg("study"), py::arg("settings"))
      .def("fates", &fates_of, py::arg("states"), py::arg("settings"))
      .def("attractors", &known);
}

}  // namespace equipoise::python
