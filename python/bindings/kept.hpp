// Results that stay with Python as the library made them, to be printed and saved by it.
#pragma once

#include <string>

#include <pybind11/pybind11.h>

namespace equipoise::python {

namespace py = pybind11;

/// What a call answered, and whether Ctrl-C cut it short.
template <class Result>
struct Kept {
  Result result;
  bool interrupted = false;
};

/// Its class, with what all results have: text, json, interrupted.
template <class Result>
py::class_<Kept<Result>> bind_kept(py::module_& module, const char* name, std::string (*text)(const Result&),
                                   std::string (*json)(const Result&)) {
  return py::class_<Kept<Result>>(module, name)
      .def("text", [text](const Kept<Result>& kept) { return text(kept.result); })
      .def("json", [json](const Kept<Result>& kept) { return json(kept.result); })
      .def_readonly("interrupted", &Kept<Result>::interrupted);
}

}  // namespace equipoise::python
