// Sweeps, capacities, designs, and what files of results hold.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "equipoise/analyses/design/design.hpp"
#include "equipoise/analyses/sweeps/capacity.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/results/result_files/inspection.hpp"

namespace equipoise::python {

namespace {

// What [sweep] says.
py::tuple sweep_setting(const PyStudy& s) { return py::make_tuple(s.study.sweep.over, s.study.sweep.zip); }

Kept<SweepResult> run_sweep(const PyStudy& s, const std::vector<std::string>& over, bool zip, double half_width,
                            bool limit_given, std::optional<bool> transients, const std::string& output,
                            std::size_t shard, std::size_t shards, const py::dict& settings) {
  BasinOptions request;
  request.half_width = half_width;
  request.limit_given = limit_given;
  request.transients = transients;
  const SweepPlan plan(s.source, sweep_axes(over, zip, "over"), request, "over");
  CallWith<SweepOptions> call(settings);
  call.options.output = output;
  call.options.shard = shard;
  call.options.shards = shards;
  return call.keep([&] { return sweep(plan, call.options); }, s.source);
}

Kept<SweepResult> merge(const std::vector<std::string>& files, const std::string& output) {
  CallWith<> call{py::dict()};
  return call.keep([&] { return merge_sweeps(files, output, call.options); });
}

Kept<CapacityResult> find_capacity(const PyStudy& s, const std::string& of, const std::string& between, double at_least,
                                   const std::string& by, double precision, const std::vector<std::string>& over,
                                   bool zip, const std::string& output, const py::dict& settings) {
  BasinOptions request;
  request.transients = by != "balanced";
  const std::vector<SweepAxis> axes = over.empty() ? std::vector<SweepAxis>{} : sweep_axes(over, zip, "over");
  const SweepPlan plan(of.empty() ? with_unbalance(s.source, axes) : s.source, axes, request, "over");
  CallWith<CapacityOptions> call(settings);
  CapacityOptions& options = call.options;
  options.key = capacity_key(plan.source(), of, options.of);
  static_cast<CapacityRange&>(options) = capacity_range(plan, options.key, between, "between");
  options.at_least = at_least;
  options.by = by;
  options.precision = precision;
  options.output = output;
  return call.keep([&] { return capacity(plan, options); }, plan.source());
}

Kept<DesignResult> find_design(const PyStudy& s, const std::string& output, const py::dict& settings) {
  const DesignProblem problem(s.source);
  CallWith<DesignOptions> call(settings);
  call.options.output = output;
  call.options.search_time_over = [&call] { return call.half_over(); };
  return call.keep([&] { return design(problem, call.options); }, s.source);
}

// The chosen study, its name that of the study asked.
std::optional<PyStudy> best_of(const Kept<DesignResult>& d) {
  if (!d.result.chosen) return std::nullopt;
  return PyStudy({d.result.best_study, d.source.name, {}});
}

Kept<Inspection> inspect(const std::string& path) {
  return {Call::run([&] { return inspect_file(path); })};
}

}  // namespace

void bind_sweeps(py::module_& module) {
  bind_kept<SweepResult>(module, "Sweep", &result_text<SweepResult>)
      .def("csv", made<SweepResult>(&sweep_csv))
      .def("page", paged<SweepResult>())
      .def("study", [](const Kept<SweepResult>& s) { return PyStudy::of(s.result.study); })
      .def("save", saved<SweepResult>(&write_sweep_file));
  module.def("sweep_setting", &sweep_setting);
  module.def("sweep", &run_sweep);
  module.def("merge", &merge);
  bind_kept<CapacityResult>(module, "Capacity", &result_text<CapacityResult>)
      .def("csv", made<CapacityResult>(&capacity_csv))
      .def("page", paged<CapacityResult>());
  module.def("capacity", &find_capacity);
  bind_kept<DesignResult>(module, "Design", &result_text<DesignResult>)
      .def("csv", made<DesignResult>(&design_csv))
      .def("page", paged<DesignResult>())
      .def("best", &best_of);
  module.def("design", &find_design);
  bind_kept<Inspection>(module, "Inspection", &inspection_text);
  module.def("inspect", &inspect);
}

}  // namespace equipoise::python
