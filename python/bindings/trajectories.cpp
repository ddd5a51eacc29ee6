// Trajectories: one, or those of many starts.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/analyses/one_study/trajectories.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/trajectory_file.hpp"
#include "equipoise/simulation/trajectory/simulate.hpp"

namespace equipoise::python {

namespace {

// One run, or many along a first dimension.
struct Runs {
  Trajectories all;
  bool many = false, interrupted = false;
  Study study;  // as simulated

  const Trajectory& first() const { return all.runs.front(); }
  // A row a run if they are many; missing rows are not-a-number.
  py::array_t<double> column(const TrajectoryColumn& c) const;
};

py::array_t<double> Runs::column(const TrajectoryColumn& c) const {
  if (many && c.values == &Trajectory::t) return array_of(std::vector<double>(all.times));
  const std::size_t rows = many ? all.times.size() : first().t.size();
  const std::size_t each = c.each ? (first().*c.each).size() : 1;
  std::vector<py::ssize_t> shape;
  for (const std::size_t length : {all.runs.size(), rows, each}) shape.push_back(static_cast<py::ssize_t>(length));
  if (!c.each) shape.pop_back();
  if (!many) shape.erase(shape.begin());
  py::array_t<double> result(shape);
  double* to = result.mutable_data();
  for (const Trajectory& run : all.runs)
    for (std::size_t k = 0; k < rows; ++k)
      for (std::size_t i = 0; i < each; ++i) {
        const std::vector<double>& values = c.each ? (run.*c.each)[i] : run.*c.values;
        *to++ = k < values.size() ? values[k] : no_number;
      }
  return result;
}

py::dict columns(const Runs& runs) {
  py::dict result;
  for (const TrajectoryColumn& c : trajectory_columns)
    if (c.is_in(runs.first())) result[c.name] = runs.column(c);
  return result;
}

std::vector<std::string> statuses(const Runs& runs) {
  std::vector<std::string> names;
  for (const Trajectory& run : runs.all.runs) {
    const bool cut = run.status == IntegrationStatus::done && run.t.size() < runs.all.times.size();
    names.emplace_back(cut ? "stopped" : name_of(run.status));
  }
  return names;
}

Runs simulate_study(const PyStudy& s, const std::optional<std::vector<double>>& times, std::optional<double> until,
                    std::optional<double> every, const std::optional<py::array>& initial, bool drawn, bool one,
                    const py::dict& settings) {
  Runs runs{{}, !one && (initial || drawn), false, with_medians(s.study)};
  Study& study = runs.study;
  const std::vector<double> at = times ? *times : output_times(study, until, every);
  std::vector<InitialState> starts;
  if (initial) starts = starts_from(study, *initial, "initial");
  if (drawn) starts = drawn_starts(study);
  if (one) study.initial = starts.front();
  CallWith<> call(settings);
  runs.all = Call::run([&] {
    if (runs.many) return simulate(study, starts, at, call.options);
    Trajectory run = simulate(study, at, call.options);
    const bool stopped = run.stopped;
    return Trajectories{at, {std::move(run)}, stopped};
  });
  runs.interrupted = call.interrupted();
  return runs;
}

// As Python keeps it: the study, the times, of every run its rows and status, and the columns.
py::tuple state_of(const Runs& runs) {
  std::vector<std::size_t> rows;
  std::vector<int> status;
  for (const Trajectory& run : runs.all.runs) {
    rows.push_back(run.t.size());
    status.push_back(static_cast<int>(run.status));
  }
  return py::make_tuple(to_toml(runs.study), runs.study.name, runs.many, runs.all.times, rows, status, columns(runs));
}

Runs from_state(const py::tuple& state) {
  Runs runs{{}, state[2].cast<bool>(), false, parse_study(state[0].cast<std::string>(), state[1].cast<std::string>())};
  runs.all.times = state[3].cast<std::vector<double>>();
  const auto rows = state[4].cast<std::vector<std::size_t>>();
  const auto status = state[5].cast<std::vector<int>>();
  const auto columns = state[6].cast<py::dict>();
  runs.all.runs.resize(rows.size());
  const std::size_t most = runs.many ? runs.all.times.size() : rows.front();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Trajectory& run = runs.all.runs[i];
    run.status = static_cast<IntegrationStatus>(status[i]);
    run.tilts = columns.contains("tilt_x");
    for (const TrajectoryColumn& c : trajectory_columns) {
      if (!columns.contains(c.name)) continue;
      const auto values = columns[c.name].cast<py::array_t<double, py::array::c_style | py::array::forcecast>>();
      const bool shared = c.values == &Trajectory::t;
      const std::size_t each = c.each ? static_cast<std::size_t>(values.shape(values.ndim() - 1)) : 1;
      if (c.each) (run.*c.each).resize(each);
      const double* from = values.data() + (shared ? 0 : i * most * each);
      for (std::size_t k = 0; k < rows[i] * each; ++k)
        (c.each ? (run.*c.each)[k % each] : run.*c.values).push_back(from[k]);
    }
  }
  return runs;
}

void save(const Runs& runs, const std::string& path) {
  const auto write = [&](const auto& what) {
    if (path.ends_with(".csv"))
      io::write_whole(path, trajectory_csv(what, runs.study));
    else
      write_netcdf(path, what, to_toml(runs.study));
  };
  if (runs.many)
    write(runs.all);
  else
    write(runs.first());
}

}  // namespace

void bind_trajectories(py::module_& module) {
  module.def("trajectory_columns", [] { return attributes_of_all(trajectory_columns); });
  module.def("simulate", &simulate_study);
  py::class_<Runs>(module, "Runs")
      .def("columns", &columns)
      .def("save", &save)
      .def_property_readonly("statuses", &statuses)
      .def_readonly("interrupted", &Runs::interrupted)
      .def(py::pickle(&state_of, &from_state));
}

}  // namespace equipoise::python
