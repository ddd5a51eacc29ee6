// Designs.
#include "bindings.hpp"
#include "call.hpp"
#include "equipoise/analyses/design/design.hpp"
#include "equipoise/report/html/design_html.hpp"
#include "equipoise/report/html/given_machine.hpp"
#include "equipoise/report/reports/design_report.hpp"
#include "kept.hpp"
#include "py_study.hpp"

namespace equipoise::python {

namespace {

using Design = Kept<DesignResult>;

Design find_design(const PyStudy& s, const std::string& output, const py::dict& settings) {
  const DesignProblem problem(s.source);
  Call call(settings);
  DesignOptions options;
  call.set(options);
  options.output = output;
  options.search_time_over = [&call] { return call.half_over(); };
  DesignResult result = Call::run([&] { return design(problem, options); });
  return {std::move(result), call.interrupted(), s.source};
}

std::string page_of(const Design& d) {
  return design_html(d.result, given_machine(d.source.toml, d.source.name, d.source.overrides));
}

// The chosen study, its name that of the study asked.
py::object best_of(const Design& d) {
  if (!d.result.chosen) return py::none();
  return py::cast(PyStudy({d.result.best_study, d.source.name, {}}));
}

}  // namespace

void bind_designs(py::module_& module) {
  bind_kept<DesignResult>(module, "Design", &design_text, &design_json)
      .def("csv", [](const Design& d) { return design_csv(d.result); })
      .def("page", &page_of)
      .def("best", &best_of);
  module.def("design", &find_design, py::arg("study"), py::arg("output"), py::arg("settings"));
}

}  // namespace equipoise::python
