// One trajectory.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "equipoise/result_files/trajectory_file.hpp"
#include "equipoise/trajectory/output_times.hpp"
#include "equipoise/trajectory/simulate.hpp"
#include "py_study.hpp"

namespace equipoise::python {

namespace {

const char* status_name(const Trajectory& run) {
  if (run.stopped) return "stopped";
  if (run.status == IntegrationStatus::done) return "done";
  return run.status == IntegrationStatus::diverged ? "diverged" : "failed";
}

py::dict to_dict(Trajectory run) {
  py::dict result;
  const std::size_t rows = run.t.size();
  result["status"] = status_name(run);
  result["phi"] = columns_of(run.phi, rows);
  result["phi_dot"] = columns_of(run.phi_dot, rows);
  for (const auto& [name, column] : {std::pair{"t", &run.t},
                                     {"psi", &run.psi},
                                     {"psi_dot", &run.psi_dot},
                                     {"x", &run.x},
                                     {"y", &run.y},
                                     {"x_dot", &run.x_dot},
                                     {"y_dot", &run.y_dot},
                                     {"radial", &run.radial},
                                     {"bearing_x", &run.bearing_x},
                                     {"bearing_y", &run.bearing_y}})
    result[name] = array_of(std::move(*column));
  return result;
}

py::dict simulate_study(const PyStudy& s, const std::optional<std::vector<double>>& times, std::optional<double> until,
                        std::optional<double> every, const py::dict& settings) {
  const Study study = with_medians(s.study);
  const std::vector<double> at = times ? *times : output_times(study, until, every);
  Call call(settings);
  RunOptions options;
  call.set(options);
  Trajectory run = Call::run([&] { return simulate(study, at, options); });
  py::dict result = to_dict(std::move(run));
  result["interrupted"] = call.interrupted();
  return result;
}

// The columns that to_dict() made, as a trajectory again.
Trajectory from_dict(const py::dict& columns) {
  const auto column = [&](const char* name) { return columns[name].cast<std::vector<double>>(); };
  const auto by_ball = [&](const char* name) {
    const auto table = columns[name].cast<py::array_t<double>>();
    std::vector<std::vector<double>> result(static_cast<std::size_t>(table.shape(1)));
    for (py::ssize_t i = 0; i < table.shape(1); ++i)
      for (py::ssize_t k = 0; k < table.shape(0); ++k) result[static_cast<std::size_t>(i)].push_back(table.at(k, i));
    return result;
  };
  Trajectory run;
  run.t = column("t");
  run.psi = column("psi");
  run.psi_dot = column("psi_dot");
  run.x = column("x");
  run.y = column("y");
  run.x_dot = column("x_dot");
  run.y_dot = column("y_dot");
  run.phi = by_ball("phi");
  run.phi_dot = by_ball("phi_dot");
  run.radial = column("radial");
  run.bearing_x = column("bearing_x");
  run.bearing_y = column("bearing_y");
  return run;
}

void save(const py::dict& columns, const PyStudy& s, const std::string& path) {
  const Trajectory run = from_dict(columns);
  if (path.ends_with(".csv"))
    write_csv_file(path, run);
  else
    write_netcdf(path, run, to_toml(with_medians(s.study)));
}

}  // namespace

void bind_trajectories(py::module_& module) {
  module.def("simulate", &simulate_study, py::arg("study"), py::arg("times"), py::arg("until"), py::arg("every"),
             py::arg("settings"));
  module.def("save_trajectory", &save, py::arg("columns"), py::arg("study"), py::arg("path"));
}

}  // namespace equipoise::python
