// What the parts of the module equipoise._core share: studies, calls, results. What they return is plain: numbers,
// arrays, text, dictionaries; the package's Python code makes objects of it.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <pybind11/pybind11.h>

#include "equipoise/analyses/sweeps/sweep_plan.hpp"
#include "equipoise/core/running/deadline.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/text/table_text.hpp"
#include "equipoise/study/contents/study.hpp"

namespace equipoise::python {

namespace py = pybind11;
using namespace py::literals;

/// A study as Python holds it: its text, what was set on top of it, and what that reads as.
struct PyStudy {
  StudySource source;
  Study study;

  explicit PyStudy(StudySource from) : source(std::move(from)), study(source.with()) {}
  /// With all its defaults as its text.
  static PyStudy of(const Study& study) { return PyStudy({to_toml(study), study.name, {}}); }

  PyStudy with(const std::vector<std::string>& more) const {
    StudySource changed = source;
    changed.overrides.insert(changed.overrides.end(), more.begin(), more.end());
    return PyStudy(std::move(changed));
  }
};

/// A result that stays with Python as the library made it, to be printed and saved by it; whether Ctrl-C cut the call
/// short, and the study as written, for the machine of its page.
template <class Result>
struct Kept {
  Result result;
  bool interrupted = false;
  StudySource source{};
};

/// One long call: its threads, progress and Ctrl-C. Its callbacks run on the thread that made it, with the
/// interpreter's lock taken back for as long.
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
  /// What it makes, to be kept; `source`: of a result that has a page.
  template <class Work>
  auto keep(Work&& work, StudySource source = {}) {
    auto result = run(std::forward<Work>(work));
    return Kept<decltype(result)>{std::move(result), interrupted_, std::move(source)};
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

/// One with the options of its work.
template <class Options = RunOptions>
struct CallWith : Call {
  Options options;

  explicit CallWith(const py::dict& settings, Options from = {}) : Call(settings), options(std::move(from)) {
    set(options);
  }
};

/// The machine of a page: from the study as it was given, or as a file of results has it.
template <class Result>
GivenMachine machine_of(const Kept<Result>& kept) {
  if (kept.source.toml.empty()) return given_machine(kept.result.study);
  return given_machine(kept.source.toml, kept.source.name, kept.source.overrides);
}

/// A method that gives what `make` makes of the result, in a style for the terminal if it takes one.
template <class Result, class Make>
auto made(Make make) {
  return [make](const Kept<Result>& kept) {
    if constexpr (std::is_invocable_v<Make, const Result&>)
      return make(kept.result);
    else
      return make(kept.result, wide_style);
  };
}

/// A method that gives its page.
template <class Result>
auto paged() {
  return [](const Kept<Result>& kept) { return result_page(kept.result, machine_of(kept)); };
}

/// A method that writes the result.
template <class Result>
auto saved(void (*write)(const std::string&, const Result&)) {
  return [write](const Kept<Result>& kept, const std::string& path) { write(path, kept.result); };
}

/// Its class, with what all results have: text, json, interrupted.
template <class Result, class Text>
py::class_<Kept<Result>> bind_kept(py::module_& module, const char* name, Text text) {
  return py::class_<Kept<Result>>(module, name)
      .def("text", made<Result>(text))
      .def("json", [](const Kept<Result>& kept) { return json_text(kept.result); })
      .def_readonly("interrupted", &Kept<Result>::interrupted);
}

void bind_studies(py::module_& module);
void bind_trajectories(py::module_& module);
void bind_ensembles(py::module_& module);
void bind_model(py::module_& module);
void bind_motions(py::module_& module);
void bind_planes(py::module_& module);
void bind_sweeps(py::module_& module);
void bind_paper(py::module_& module);

}  // namespace equipoise::python
