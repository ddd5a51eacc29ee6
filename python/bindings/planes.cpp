// Maps, planes of stability, sweeps, capacities.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/extras/charts/chart_report.hpp"
#include "equipoise/extras/charts/stability_report.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/report/html/capacity_html.hpp"
#include "equipoise/report/html/given_machine.hpp"
#include "equipoise/report/html/map_html.hpp"
#include "equipoise/report/html/sweep_html.hpp"
#include "equipoise/extras/planes/plane_files.hpp"
#include "equipoise/report/reports/capacity_report.hpp"
#include "equipoise/report/reports/map_report.hpp"
#include "equipoise/report/reports/sweep_report.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "equipoise/results/cell_files/sweep_file.hpp"
#include "equipoise/extras/stability/over_plane.hpp"
#include "equipoise/analyses/sweeps/capacity.hpp"
#include "equipoise/analyses/sweeps/sweep.hpp"
#include "equipoise/analyses/sweeps/sweep_axis.hpp"
#include "equipoise/results/words/files.hpp"
#include "kept.hpp"
#include "py_study.hpp"

namespace equipoise::python {

namespace {

using Map = Kept<BasinSlice>;

// The machine of a page: from the study as it was given, or as a file of results has it.
template <class Result>
GivenMachine machine_of(const Kept<Result>& kept) {
  if (kept.source.toml.empty()) return given_machine(kept.result.study);
  return given_machine(kept.source.toml, kept.source.name, kept.source.overrides);
}

/// The axes of a map or a plane, each as Python gives it: key, range as text (empty: a whole turn), pixels.
template <class Settings>
void set_axes(const Study& study, const py::tuple& x, const py::tuple& y, Settings& how) {
  const int columns = x[2].cast<int>(), rows = y[2].cast<int>();
  map_size(std::to_string(columns) + "x" + std::to_string(rows), "size");
  how.x = slice_axis(study, x[0].cast<std::string>(), x[1].cast<std::string>(), columns, "x_range");
  how.y = slice_axis(study, y[0].cast<std::string>(), y[1].cast<std::string>(), rows, "y_range");
}

// What `compute` makes of a plane; what is wrong with its axes is named as Python has it.
template <class Settings, class Compute>
auto over_axes(const Settings& how, const char* made, const Compute& compute) {
  try {
    return Call::run(compute);
  } catch (const InputError& e) {
    throw under_names(e, how.x, how.y, {"x", "y", "size", made});
  }
}

Map draw_map(const PyStudy& s, const py::tuple& x, const py::tuple& y, const std::vector<std::string>& ties,
             const std::string& output, const py::dict& settings) {
  const Study study = with_medians(s.study);
  Call call(settings);
  BasinSliceSettings how;
  call.set(how);
  set_axes(study, x, y, how);
  for (const std::string& tie : ties) how.links.push_back(angle_link(tie, "tie"));
  how.output = output;
  BasinSlice map = over_axes(how, "map", [&] { return basin_slice(study, how); });
  return {std::move(map), call.interrupted(), s.source};
}

template <class Result>
void add_axes(py::dict& summary, const Result& result) {
  summary["x_key"] = result.x.key;
  summary["y_key"] = result.y.key;
  summary["x_edges"] = py::make_tuple(result.x.low, result.x.high);
  summary["y_edges"] = py::make_tuple(result.y.low, result.y.high);
}

py::array_t<double> centres(const SliceAxis& axis) {
  std::vector<double> values;
  for (int k = 0; k < axis.pixels; ++k) values.push_back(axis.centre(k));
  return array_of(std::move(values));
}

py::dict arrays_of(const Map& kept) {
  const BasinSlice& map = kept.result;
  const std::vector<py::ssize_t> shape{map.y.pixels, map.x.pixels};
  py::dict arrays;
  arrays["x"] = centres(map.x);
  arrays["y"] = centres(map.y);
  arrays["outcome"] = array_of(std::vector<short>(map.code), shape);
  arrays["time"] = array_of(std::vector<float>(map.time), shape);
  arrays["r_max"] = array_of(std::vector<float>(map.r_max), shape);
  return arrays;
}

py::object figure(const std::optional<SliceFigure>& f) {
  return f ? py::object(py::make_tuple(f->value, f->low, f->high)) : py::none();
}

py::dict summary_of(const Map& kept) {
  const BasinSlice& map = kept.result;
  py::dict summary, figures;
  py::list codes;
  for (const OutcomeShare& c : map.codes)
    codes.append(py::make_tuple(c.id, c.name, c.alias, c.share.share, c.share.low, c.share.high, c.share.count));
  figures["box_dimension"] = figure(map.figures.box_dimension);
  figures["uncertainty_exponent"] = figure(map.figures.uncertainty_exponent);
  py::list local;
  for (const LocalExponent& e : map.figures.local_exponents) local.append(py::make_tuple(e.from, e.to, e.value));
  figures["local_exponents"] = local;
  figures["basin_entropy"] = figure(map.figures.basin_entropy);
  figures["boundary_basin_entropy"] = figure(map.figures.boundary_basin_entropy);
  figures["balanced_radius"] = map.figures.balanced_radius;
  summary["codes"] = codes;
  summary["figures"] = figures;
  add_axes(summary, map);
  summary["left_out"] = map.pixels_left_out;
  summary["complete"] = map.complete;
  summary["seconds"] = map.seconds;
  return summary;
}

using Stability = Kept<StabilityPlane>;

Stability look_at_balance(const PyStudy& s, const py::tuple& x, const py::tuple& y, const std::string& output,
                          const py::dict& settings) {
  const Study study = with_medians(s.study);
  Call call(settings);
  StabilitySettings how;
  call.set(how);
  set_axes(study, x, y, how);
  how.output = output;
  StabilityPlane plane = over_axes(how, "stability", [&] { return stability(study, how); });
  return {std::move(plane), call.interrupted()};
}

py::dict arrays_of_points(const Stability& kept) {
  const StabilityPlane& plane = kept.result;
  const std::vector<py::ssize_t> shape{plane.y.pixels, plane.x.pixels};
  py::dict arrays;
  arrays["x"] = centres(plane.x);
  arrays["y"] = centres(plane.y);
  for (const PointNumber& n : point_numbers) {
    std::vector<double> numbers;
    std::vector<short> whole;
    for (const BalancePoint& p : plane.points)
      n.whole ? whole.push_back(static_cast<short>(n.value(p))) : numbers.push_back(n.value(p));
    arrays[n.name] = n.whole ? py::object(array_of(std::move(whole), shape)) : array_of(std::move(numbers), shape);
  }
  return arrays;
}

py::dict summary_of_plane(const Stability& kept) {
  const StabilityPlane& plane = kept.result;
  py::dict summary;
  add_axes(summary, plane);
  summary["own"] = plane.own ? py::object(py::make_tuple(plane.own->x, plane.own->y)) : py::none();
  summary["continuum"] = py::none();
  if (plane.own && plane.own->continuum) {
    const ContinuumPart& part = *plane.own->continuum;
    py::dict told;
    told["drawn"] = part.drawn;
    told["stable"] = part.stable;
    told["slowest_rate"] = py::make_tuple(part.slowest_rate, part.fastest_rate);
    told["growth_rate"] = py::make_tuple(part.least_growth, part.most_growth);
    summary["continuum"] = told;
  }
  summary["answer"] = stability_answer(plane);
  summary["complete"] = plane.complete;
  summary["seconds"] = plane.seconds;
  return summary;
}

using Chart = Kept<BifurcationChart>;

Chart draw_chart(const PyStudy& s, const py::tuple& x, const py::tuple& y, std::uint64_t boxes, double undecided,
                 bool cycles, const std::string& output, const py::dict& settings) {
  const Study study = with_medians(s.study);
  Call call(settings);
  ChartSettings how;
  how.cycles = cycles;
  call.set(how);
  set_axes(study, x, y, how);
  how.boxes = boxes;
  how.undecided = 0.01 * undecided;
  how.output = output;
  BifurcationChart chart = over_axes(how, "chart", [&] { return bifurcation_chart(study, how); });
  return {std::move(chart), call.interrupted()};
}

using Sweep = Kept<SweepResult>;

Sweep run_sweep(const PyStudy& s, const std::vector<std::string>& over, bool zip, double half_width, bool limit_given,
                std::optional<bool> transients, const std::string& output, std::size_t shard, std::size_t shards,
                const py::dict& settings) {
  CellRequest request;
  request.half_width = half_width;
  request.limit_given = limit_given;
  request.transients = transients;
  const SweepPlan plan(s.source, sweep_axes(over, zip, "over"), request, "over");
  Call call(settings);
  SweepOptions options;
  call.set(options);
  options.output = output;
  options.shard = shard;
  options.shards = shards;
  SweepResult result = Call::run([&] { return sweep(plan, options); });
  return {std::move(result), call.interrupted(), s.source};
}

// What [sweep] says.
py::tuple sweep_setting(const PyStudy& s) { return py::make_tuple(s.study.sweep.over, s.study.sweep.zip); }

using Capacity = Kept<CapacityResult>;

Capacity find_capacity(const PyStudy& s, const std::string& of, const std::string& between, double at_least,
                       const std::string& by, double precision, const std::vector<std::string>& over, bool zip,
                       const std::string& output, const py::dict& settings) {
  CellRequest request;
  request.transients = by != "balanced";
  const std::vector<SweepAxis> axes = over.empty() ? std::vector<SweepAxis>{} : sweep_axes(over, zip, "over");
  const SweepPlan plan(of.empty() ? with_unbalance(s.source, axes) : s.source, axes, request, "over");
  Call call(settings);
  CapacityOptions options;
  call.set(options);
  options.key = capacity_key(plan.source(), of, options.of);
  const CapacityRange range = capacity_range(plan, options.key, between, "between");
  options.from = range.from;
  options.to = range.to;
  options.unit = range.unit;
  options.at_least = at_least;
  options.by = by;
  options.precision = precision;
  options.output = output;
  CapacityResult result = Call::run([&] { return capacity(plan, options); });
  return {std::move(result), call.interrupted(), plan.source()};
}

}  // namespace

void bind_planes(py::module_& module) {
  module.attr("not_computed_code") = not_computed_code;
  module.def("pixel_numbers", [] {
    py::dict columns;
    columns["outcome"] = attributes_of(Column{"outcome", words::files::outcome_of_pixel});
    for (const PixelNumber& n : pixel_numbers) columns[n.name] = attributes_of(n);
    return columns;
  });
  module.def("axis_units", [](const std::string& key) { return SliceAxis{key}.angle() ? "radian" : "1"; });
  bind_kept<BasinSlice>(module, "Map", &map_text, &map_json)
      .def("arrays", &arrays_of)
      .def("summary", &summary_of)
      .def("page", [](const Map& m) { return map_html(m.result, machine_of(m)); })
      .def("save", [](const Map& m, const std::string& path) { write_map_file(path, m.result); });
  module.def("map", &draw_map, py::arg("study"), py::arg("x"), py::arg("y"), py::arg("ties"), py::arg("output"),
             py::arg("settings"));
  module.def("point_numbers", [] {
    py::dict columns;
    for (const PointNumber& n : point_numbers) columns[n.name] = attributes_of(n);
    return columns;
  });
  module.attr("balance_kinds") = std::vector<std::string>(balance_kind_names.begin(), balance_kind_names.end());
  bind_kept<StabilityPlane>(module, "Stability", &stability_text, &stability_json)
      .def("arrays", &arrays_of_points)
      .def("summary", &summary_of_plane)
      .def("csv", [](const Stability& s) { return stability_csv(s.result); })
      .def("save", [](const Stability& s, const std::string& path) { write_stability_file(path, s.result); });
  module.def("stability", &look_at_balance, py::arg("study"), py::arg("x"), py::arg("y"), py::arg("output"),
             py::arg("settings"));
  bind_kept<BifurcationChart>(module, "Chart", &chart_text, &chart_json)
      .def("csv", [](const Chart& c) { return chart_csv(c.result); })
      .def("save", [](const Chart& c, const std::string& path) { write_chart_file(path, c.result); });
  module.def("chart", &draw_chart, py::arg("study"), py::arg("x"), py::arg("y"), py::arg("boxes"), py::arg("undecided"),
             py::arg("cycles"), py::arg("output"), py::arg("settings"));
  bind_kept<SweepResult>(module, "Sweep", &sweep_text, &sweep_json)
      .def("csv", [](const Sweep& s) { return sweep_csv(s.result); })
      .def("page", [](const Sweep& s) { return sweep_html(s.result, machine_of(s)); })
      .def("study",
           [](const Sweep& s) {
             return PyStudy({to_toml(s.result.study), s.result.study.name, {}});
           })
      .def("save", [](const Sweep& s, const std::string& path) { write_sweep_file(path, s.result); });
  module.def("sweep_setting", &sweep_setting, py::arg("study"));
  module.def("sweep", &run_sweep, py::arg("study"), py::arg("over"), py::arg("zip"), py::arg("half_width"),
             py::arg("limit_given"), py::arg("transients"), py::arg("output"), py::arg("shard"), py::arg("shards"),
             py::arg("settings"));
  bind_kept<CapacityResult>(module, "Capacity", &capacity_text, &capacity_json)
      .def("csv", [](const Capacity& c) { return capacity_csv(c.result); })
      .def("page", [](const Capacity& c) { return capacity_html(c.result, machine_of(c)); });
  module.def("capacity", &find_capacity, py::arg("study"), py::arg("of"), py::arg("between"), py::arg("at_least"),
             py::arg("by"), py::arg("precision"), py::arg("over"), py::arg("zip"), py::arg("output"),
             py::arg("settings"));
}

}  // namespace equipoise::python
