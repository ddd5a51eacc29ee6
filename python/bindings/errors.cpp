// The library's exceptions as Python's.
#include "bindings.hpp"

#include <exception>

#include "equipoise/core/base/error.hpp"

namespace equipoise::python {

namespace {

void raise(const char* kind, const py::tuple& arguments) {
  const py::object type = py::module_::import("equipoise.errors").attr(kind);
  const py::object error = type(*arguments);
  PyErr_SetObject(type.ptr(), error.ptr());
}

}  // namespace

void bind_errors(py::module_&) {
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const InputError& e) {
      raise("StudyError", py::make_tuple(e.what(), e.key(), e.value(), e.wrong(), e.allowed(), e.where()));
    } catch (const RunError& e) {
      raise("RunError", py::make_tuple(e.what()));
    }
  });
}

}  // namespace equipoise::python
