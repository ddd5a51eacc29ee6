// Results that stay with Python as the library made them, to be printed and saved by it.
#pragma once

#include <string>
#include <type_traits>

#include <pybind11/pybind11.h>

#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise::python {

namespace py = pybind11;

/// What a call answered, whether Ctrl-C cut it short, and the study as written, for the machine of its page.
template <class Result>
struct Kept {
  Result result;
  bool interrupted = false;
  StudySource source{};
};

/// Its class, with what all results have: text, json, interrupted.
/// `text`: for the terminal, in a style or in none.
template <class Result, class Text, class Json>
py::class_<Kept<Result>> bind_kept(py::module_& module, const char* name, Text text, Json json) {
  return py::class_<Kept<Result>>(module, name)
      .def("text",
           [text](const Kept<Result>& kept) {
             if constexpr (std::is_invocable_v<Text, const Result&>)
               return text(kept.result);
             else
               return text(kept.result, wide_style);
           })
      .def("json", [json](const Kept<Result>& kept) { return json(kept.result); })
      .def_readonly("interrupted", &Kept<Result>::interrupted);
}

}  // namespace equipoise::python
