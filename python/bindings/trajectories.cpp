// One trajectory.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/trajectory_file.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise::python {

namespace {

py::dict to_dict(Trajectory run) {
  py::dict result;
  const std::size_t rows = run.t.size();
  result["status"] = run.stopped ? "stopped" : name_of(run.status);
  for (const TrajectoryColumn& c : trajectory_columns)
    if (c.is_in(run)) result[c.name] = c.each ? columns_of(run.*c.each, rows) : array_of(std::move(run.*c.values));
  return result;
}

py::dict simulate_study(const PyStudy& s, const std::optional<std::vector<double>>& times, std::optional<double> until,
                        std::optional<double> every, const py::dict& settings) {
  const Study study = with_medians(s.study);
  const std::vector<double> at = times ? *times : output_times(study, until, every);
  CallWith<> call(settings);
  py::dict result = to_dict(Call::run([&] { return simulate(study, at, call.options); }));
  result["interrupted"] = call.interrupted();
  return result;
}

// The columns that to_dict() made, as a trajectory again.
Trajectory from_dict(const py::dict& columns) {
  Trajectory run;
  run.tilts = columns.contains("tilt_x");
  for (const TrajectoryColumn& c : trajectory_columns) {
    if (!columns.contains(c.name)) continue;
    if (c.values) {
      run.*c.values = columns[c.name].cast<std::vector<double>>();
      continue;
    }
    const auto table = columns[c.name].cast<py::array_t<double>>();
    for (py::ssize_t i = 0; i < table.shape(1); ++i) {
      std::vector<double>& of_one = (run.*c.each).emplace_back();
      for (py::ssize_t k = 0; k < table.shape(0); ++k) of_one.push_back(table.at(k, i));
    }
  }
  return run;
}

void save(const py::dict& columns, const PyStudy& s, const std::string& path) {
  const Trajectory run = from_dict(columns);
  if (path.ends_with(".csv"))
    io::write_whole(path, trajectory_csv(run, s.study));
  else
    write_netcdf(path, run, to_toml(with_medians(s.study)));
}

}  // namespace

void bind_trajectories(py::module_& module) {
  module.def("trajectory_columns", [] { return attributes_of_all(trajectory_columns); });
  module.def("simulate", &simulate_study);
  module.def("save_trajectory", &save);
}

}  // namespace equipoise::python
