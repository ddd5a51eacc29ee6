// The parts of the module equipoise._core. What they return is plain: numbers, arrays, text, dictionaries; the
// package's Python code makes objects of it.
#pragma once

#include <pybind11/pybind11.h>

namespace equipoise::python {

namespace py = pybind11;

void bind_errors(py::module_& module);
void bind_studies(py::module_& module);
void bind_trajectories(py::module_& module);
void bind_ensembles(py::module_& module);
void bind_mapper(py::module_& module);
void bind_equations(py::module_& module);
void bind_motions(py::module_& module);
void bind_planes(py::module_& module);
void bind_designs(py::module_& module);
void bind_files(py::module_& module);
void bind_paper(py::module_& module);

}  // namespace equipoise::python
