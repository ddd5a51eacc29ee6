// The module equipoise._core: the public headers of the library, for the package around it.
#include "bindings.hpp"

#include <pybind11/stl.h>

#include "equipoise/core/base/version.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

PYBIND11_MODULE(_core, module) {
  using namespace equipoise;
  namespace py = pybind11;
  module.attr("version") = version_string;
  module.def("cpu_targets", &cpu_targets);
  module.def("colour_of", &colour_of, py::arg("code"));
  module.def("axis_label", &axis_label, py::arg("key"));
  python::bind_errors(module);
  python::bind_studies(module);
  python::bind_trajectories(module);
  python::bind_ensembles(module);
  python::bind_mapper(module);
  python::bind_equations(module);
  python::bind_motions(module);
  python::bind_planes(module);
  python::bind_designs(module);
  python::bind_files(module);
  python::bind_paper(module);
}
