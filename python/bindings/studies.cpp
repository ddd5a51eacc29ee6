// Studies.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/analyses/one_study/basin_cost.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/report/explain/explain.hpp"
#include "equipoise/report/explain/new_studies.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/study/contents/keys.hpp"
#include "equipoise/study/echo/physical_echo.hpp"
#include "equipoise/study/reading/table_reader.hpp"
#include "equipoise/study/toml/overrides.hpp"

namespace equipoise::python {

namespace {

PyStudy study_from_tree(const py::dict& dictionary, const std::string& name) {
  const StudyValue tree = value_from(dictionary);
  study_from(tree, name);  // refuses what is none before it becomes text
  return PyStudy({to_toml(tree), name, {}});
}

py::object scales_of(const PyStudy& s) {
  const auto& scales = s.study.scales;
  if (!scales) return py::none();
  return py::dict("mass"_a = scales->mass, "length"_a = scales->length, "time"_a = scales->time());
}

// The tables as they are stated: of a machine with masses and lengths in their units.
py::object stated(const PyStudy& s) {
  return to_python(study::parse_study_file(s.source.toml, s.source.name, s.source.overrides).root);
}

// The values of a table's keys; None where none is set. One a ball as a list, without the room for more of them.
void add_values(const char* table, const Study& study, py::dict& values) {
  for (const study::Key& key : study::key_table(table).of(study::all_variants, false)) {
    const auto value = study::value_of(key, study);
    values[key.name] = value ? to_python(*value) : py::none();
  }
}

py::dict limits_of(const PyStudy& s) {
  py::dict limits;
  add_values("limits", s.study, limits);
  return limits;
}

py::dict parameters_of(const PyStudy& s) {
  const Study study = with_medians(s.study);
  py::dict parameters, tilt;
  for (const char* table : {"rotor", "balancer"}) add_values(table, study, parameters);
  if (study.parameters.tilts()) {
    add_values("rotor.tilt", study, tilt);
    parameters["tilt"] = tilt;
  }
  return parameters;
}

// What starts begin with that name no more than ball angles.
py::dict initial_of(const PyStudy& s) {
  const InitialState& start = s.study.initial;
  py::dict initial = rotor_of(start);
  initial["phi_dot"] = std::vector<double>(start.phi_dot.begin(), start.phi_dot.begin() + s.study.parameters.balls);
  return initial;
}

// The rotor's speed in the end, where it is prescribed.
std::optional<double> final_speed_of(const PyStudy& s) {
  const model::System system = with_medians(s.study).system();
  if (!system.prescribed()) return std::nullopt;
  return system.drive().speed;
}

// Where psi, psi_dot and speed_error_integral are in a motion's state; -1: nowhere.
py::tuple places_of(const PyStudy& s) {
  const model::StateLayout layout = with_medians(s.study).system().layout();
  return py::make_tuple(layout.psi, layout.speed, layout.error);
}

bool angle_matters(const PyStudy& s) { return !with_medians(s.study).system().autonomous(); }

// Key and unit of each value that starts draw, in the order of the columns drawn.
py::list uncertain_of(const PyStudy& s) {
  py::list values;
  for (const UncertainValue& value : s.study.uncertain.values) values.append(py::make_tuple(value.key, value.unit));
  return values;
}

py::dict explained(const PyStudy& s, const std::optional<std::string>& cost_within, const py::dict& settings) {
  Explanation e = explain(with_medians(s.study));
  CallWith<> call(settings);
  if (cost_within) {
    const double patience = cost_within->empty() ? cost_patience : read_time_limit("within", *cost_within);
    e.cost = Call::run([&] { return measure_cost(s.study, call.options, patience); });
  }
  return py::dict("text"_a = explain_text(e), "json"_a = json_text(e), "interrupted"_a = call.interrupted());
}

py::dict checked(const PyStudy& s) {
  const StudyCheck check = check_study(s.source.toml, s.source.name, s.source.overrides);
  return py::dict("machine"_a = check.machine, "unbalance"_a = check.unbalance, "balls"_a = check.balls,
                  "assumed"_a = check.assumed, "matters_most"_a = check.most,
                  "text"_a = lines_filled(check.text(), wide_style));
}

}  // namespace

void bind_studies(py::module_& module) {
  module.attr("overrides_name") = overrides_name;
  module.def("new_machines", &new_machines);
  module.def("new_study", [](const std::string& machine) { return new_study(machine, "machine"); });
  const auto of_text = [](const std::string& toml, const std::string& name, const std::vector<std::string>& overrides) {
    return PyStudy({toml, name, overrides});
  };
  py::class_<PyStudy>(module, "Study")
      .def(py::init(of_text), py::arg(), py::arg(), py::arg("overrides") = std::vector<std::string>{})
      .def_static("from_tree", &study_from_tree)
      .def_static("from_file",
                  [](const std::string& path) {
                    return PyStudy({read_study_text(path), path, {}});
                  })
      .def("with_overrides", &PyStudy::with)
      .def("to_toml", [](const PyStudy& s) { return to_toml(s.study); })
      .def("to_physical_toml", [](const PyStudy& s) { return to_physical_toml(s.study); })
      .def("tree", [](const PyStudy& s) { return to_python(to_tree(s.study)); })
      .def("stated", &stated)
      .def("explain", &explained)
      .def("check", &checked)
      .def_property_readonly("parameters_text", [](const PyStudy& s) { return parameters_text(s.study, {}); })
      .def_property_readonly("name", [](const PyStudy& s) { return s.source.name; })
      .def_property_readonly("balls", [](const PyStudy& s) { return s.study.parameters.balls; })
      .def_property_readonly("uncertain", &uncertain_of)
      .def_property_readonly("driven", [](const PyStudy& s) { return s.study.speed.driven(); })
      .def_property_readonly("scales", &scales_of)
      .def_property_readonly("limits", &limits_of)
      .def_property_readonly("parameters", &parameters_of)
      .def_property_readonly("initial", &initial_of)
      .def_property_readonly("initial_speed", [](const PyStudy& s) { return with_medians(s.study).drive().speed; })
      .def_property_readonly("final_speed", &final_speed_of)
      .def_property_readonly("state_places", &places_of)
      .def_property_readonly("angle_matters", &angle_matters)
      .def_property_readonly("release_time", [](const PyStudy& s) { return s.study.release_time(); })
      .def(py::pickle([](const PyStudy& s) { return py::make_tuple(s.source.toml, s.source.name, s.source.overrides); },
                      [](const py::tuple& state) {
                        return PyStudy({state[0].cast<std::string>(), state[1].cast<std::string>(),
                                        state[2].cast<std::vector<std::string>>()});
                      }));
}

}  // namespace equipoise::python
