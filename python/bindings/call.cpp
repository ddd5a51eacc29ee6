// What every long call from Python shares.
#include "call.hpp"

namespace equipoise::python {

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
