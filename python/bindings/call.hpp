// What every long call from Python shares: threads, progress, Ctrl-C, and the interpreter's lock given up meanwhile.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include <pybind11/pybind11.h>

#include "equipoise/core/running/deadline.hpp"
#include "equipoise/core/running/run_options.hpp"

namespace equipoise::python {

namespace py = pybind11;

/// One call. Its callbacks run on the thread that made it, with the interpreter's lock taken back for as long.
class Call {
 public:
  /// `settings`: "threads", "cpu", "within" (a time as --within takes it, from now on) and "progress" (a callable or
  /// None), each may be left out.
  explicit Call(const py::dict& settings);

  void set(RunOptions& options);
  /// Ctrl-C came: what the call returned is what was done by then.
  bool interrupted() const { return interrupted_; }
  /// Half of the time is over; never where there is no limit.
  bool half_over() const { return deadline_ && deadline_->half_over(); }

  /// Runs the work without the interpreter's lock.
  template <class Work>
  static auto run(Work&& work) {
    const py::gil_scoped_release unlocked;
    return std::forward<Work>(work)();
  }

 private:
  bool stop_asked();
  void report(const Progress& progress);

  int threads_ = 0;
  std::string cpu_;
  py::object progress_;
  bool interrupted_ = false;
  StopFlag over_{false};
  std::optional<Deadline> deadline_;
};

}  // namespace equipoise::python
