// The module equipoise._core: the public headers of the library, for the package around it. What every long call
// shares.
#include "bindings.hpp"

#include <exception>

#include <pybind11/stl.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/version.hpp"
#include "equipoise/report/drawing/plot_parts.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"

namespace equipoise::python {

namespace {

void raise(const char* kind, const py::tuple& arguments) {
  const py::object type = py::module_::import("equipoise.errors").attr(kind);
  const py::object error = type(*arguments);
  PyErr_SetObject(type.ptr(), error.ptr());
}

// The library's exceptions as Python's.
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const InputError& e) {
    raise("StudyError", py::make_tuple(e.what(), e.key(), e.value(), e.wrong(), e.allowed(), e.where()));
  } catch (const RunError& e) {
    raise("RunError", py::make_tuple(e.what()));
  }
}

}  // namespace

Call::Call(const py::dict& settings) : progress_(py::none()) {
  if (settings.contains("threads")) threads_ = settings["threads"].cast<int>();
  if (settings.contains("cpu") && !settings["cpu"].is_none()) cpu_ = settings["cpu"].cast<std::string>();
  if (settings.contains("progress")) progress_ = settings["progress"];
  if (settings.contains("within") && !settings["within"].is_none())
    deadline_.emplace(over_, read_time_limit("within", settings["within"].cast<std::string>()));
}

void Call::set(RunOptions& options) {
  options.threads = threads_;
  options.cpu_target = cpu_;
  options.stop = &over_;
  options.stop_asked = [this] { return stop_asked(); };
  options.notice = [](const std::string& sentence) {
    const py::gil_scoped_acquire locked;
    if (PyErr_WarnEx(PyExc_UserWarning, sentence.c_str(), 2) != 0) throw py::error_already_set();
  };
  if (!progress_.is_none()) options.progress = [this](const Progress& p) { report(p); };
}

// Ctrl-C ends the work, and what is done comes back; what another handler of signals throws goes through.
bool Call::stop_asked() {
  if (interrupted_) return true;
  const py::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() == 0) return false;
  if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt)) throw py::error_already_set();
  PyErr_Clear();
  return interrupted_ = true;
}

void Call::report(const Progress& p) {
  if (interrupted_) return;
  const py::gil_scoped_acquire locked;
  try {
    progress_(p.done, p.total, p.what, p.preparing, p.balanced ? py::object(py::float_(*p.balanced)) : py::none());
  } catch (const py::error_already_set& e) {
    if (!e.matches(PyExc_KeyboardInterrupt)) throw;
    interrupted_ = true;
  }
}

}  // namespace equipoise::python

PYBIND11_MODULE(_core, module) {
  using namespace equipoise;
  namespace py = pybind11;
  py::register_exception_translator(&python::translate);
  module.attr("version") = version_string;
  module.def("cpu_targets", &cpu_targets);
  module.def("colour_of", &colour_of);
  module.def("axis_label", &axis_label);
  python::bind_studies(module);
  python::bind_trajectories(module);
  python::bind_ensembles(module);
  python::bind_model(module);
  python::bind_motions(module);
  python::bind_planes(module);
  python::bind_sweeps(module);
  python::bind_paper(module);
}
