// Maps, planes of stability, charts.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/analyses/basin_slices/slice_axis.hpp"
#include "equipoise/analyses/basin_slices/basin_slice.hpp"
#include "equipoise/extras/charts/plane_reports.hpp"
#include "equipoise/extras/curves/bifurcation_chart.hpp"
#include "equipoise/report/html/page_parts.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/results/result_files/slice_file.hpp"
#include "equipoise/extras/stability/over_plane.hpp"

namespace equipoise::python {

namespace {

// What `compute` makes of a plane. Axes are as Python gives them: key, range as text (empty: a whole turn), pixels;
// what is wrong with them is named as Python has it.
template <class Settings, class Compute>
auto over_plane(const PyStudy& s, const py::tuple& x, const py::tuple& y, const std::string& output,
                const py::dict& settings, const Settings& given, const char* made, StudySource source,
                const Compute& compute) {
  const Study study = with_medians(s.study);
  CallWith<Settings> call(settings, given);
  Settings& how = call.options;
  const int columns = x[2].cast<int>(), rows = y[2].cast<int>();
  map_size(std::to_string(columns) + "x" + std::to_string(rows), "size");
  how.x = slice_axis(study, x[0].cast<std::string>(), x[1].cast<std::string>(), columns, "x_range");
  how.y = slice_axis(study, y[0].cast<std::string>(), y[1].cast<std::string>(), rows, "y_range");
  how.output = output;
  try {
    return call.keep([&] { return compute(study, how); }, std::move(source));
  } catch (const InputError& e) {
    throw under_names(e, how.x, how.y, {"x", "y", "size", made});
  }
}

Kept<BasinSlice> draw_map(const PyStudy& s, const py::tuple& x, const py::tuple& y,
                          const std::vector<std::string>& ties, const std::string& output, const py::dict& settings) {
  BasinSliceSettings given;
  for (const std::string& tie : ties) given.links.push_back(angle_link(tie, "tie"));
  return over_plane(s, x, y, output, settings, given, "map", s.source,
                    [](const Study& study, const BasinSliceSettings& how) { return basin_slice(study, how); });
}

// What all planes have.
template <class Result>
py::dict summary_of_plane(const Result& plane) {
  return py::dict("x_key"_a = plane.x.key, "y_key"_a = plane.y.key,
                  "x_edges"_a = py::make_tuple(plane.x.low, plane.x.high),
                  "y_edges"_a = py::make_tuple(plane.y.low, plane.y.high), "complete"_a = plane.complete,
                  "seconds"_a = plane.seconds);
}

py::array_t<double> centres(const SliceAxis& axis) {
  std::vector<double> values;
  for (int k = 0; k < axis.pixels; ++k) values.push_back(axis.centre(k));
  return array_of(std::move(values));
}

py::dict arrays_of_map(const BasinSlice& map) {
  const std::vector<py::ssize_t> shape{map.y.pixels, map.x.pixels};
  return py::dict("x"_a = centres(map.x), "y"_a = centres(map.y),
                  "outcome"_a = array_of(std::vector<short>(map.code), shape),
                  "time"_a = array_of(std::vector<float>(map.time), shape),
                  "r_max"_a = array_of(std::vector<float>(map.r_max), shape));
}

py::object figure(const std::optional<Estimate>& f) {
  return f ? py::object(py::make_tuple(f->value, f->low, f->high)) : py::none();
}

py::dict summary_of_map(const BasinSlice& map) {
  py::list codes, local;
  for (const OutcomeShare& c : map.codes)
    codes.append(py::make_tuple(c.id, c.name, c.alias, c.share.share, c.share.low, c.share.high, c.share.count));
  const SliceFigures& f = map.figures;
  for (const LocalExponent& e : f.local_exponents) local.append(py::make_tuple(e.from, e.to, e.value));
  py::dict summary = summary_of_plane(map);
  summary["codes"] = codes;
  summary["figures"] = py::dict(
      "box_dimension"_a = figure(f.box_dimension), "uncertainty_exponent"_a = figure(f.uncertainty_exponent),
      "local_exponents"_a = local, "basin_entropy"_a = figure(f.basin_entropy),
      "boundary_basin_entropy"_a = figure(f.boundary_basin_entropy), "balanced_radius"_a = f.balanced_radius,
      "tolerance_flips"_a =
          f.flipped ? py::object(py::make_tuple(f.flipped->share, f.flipped->low, f.flipped->high)) : py::none());
  summary["left_out"] = map.pixels_left_out;
  return summary;
}

Kept<StabilityPlane> look_at_balance(const PyStudy& s, const py::tuple& x, const py::tuple& y,
                                     const std::string& output, const py::dict& settings) {
  return over_plane(s, x, y, output, settings, StabilitySettings(), "stability", {},
                    [](const Study& study, const StabilitySettings& how) { return stability(study, how); });
}

py::dict arrays_of_stability(const StabilityPlane& plane) {
  const std::vector<py::ssize_t> shape{plane.y.pixels, plane.x.pixels};
  py::dict arrays("x"_a = centres(plane.x), "y"_a = centres(plane.y));
  for (const PointNumber& n : point_numbers) {
    std::vector<double> numbers;
    for (const BalancePoint& p : plane.points) numbers.push_back(n.value(p));
    arrays[n.name] = n.whole ? py::object(array_of(std::vector<short>(numbers.begin(), numbers.end()), shape))
                             : array_of(std::move(numbers), shape);
  }
  return arrays;
}

py::dict summary_of_stability(const StabilityPlane& plane) {
  py::dict summary = summary_of_plane(plane);
  summary["own"] = plane.own ? py::object(py::make_tuple(plane.own->x, plane.own->y)) : py::none();
  summary["continuum"] = py::none();
  if (plane.own && plane.own->continuum) {
    const ContinuumPart& part = *plane.own->continuum;
    summary["continuum"] = py::dict("drawn"_a = part.drawn, "stable"_a = part.stable,
                                    "slowest_rate"_a = py::make_tuple(part.slowest_rate, part.fastest_rate),
                                    "growth_rate"_a = py::make_tuple(part.least_growth, part.most_growth));
  }
  summary["answer"] = stability_answer(plane);
  return summary;
}

Kept<BifurcationChart> draw_chart(const PyStudy& s, const py::tuple& x, const py::tuple& y, std::uint64_t boxes,
                                  double undecided, bool cycles, const std::string& output, const py::dict& settings) {
  ChartSettings given;
  given.boxes = boxes;
  given.undecided = 0.01 * undecided;
  given.cycles = cycles;
  return over_plane(s, x, y, output, settings, given, "chart", {},
                    [](const Study& study, const ChartSettings& how) { return bifurcation_chart(study, how); });
}

}  // namespace

void bind_planes(py::module_& module) {
  module.attr("not_computed_code") = not_computed_code;
  module.attr("balance_kinds") = std::vector<std::string>(balance_kind_names.begin(), balance_kind_names.end());
  module.def("pixel_numbers", [] {
    py::dict columns = attributes_of_all(pixel_numbers);
    columns["outcome"] = attributes_of(Column{"outcome", "what the pixel's start comes to"});
    return columns;
  });
  module.def("point_numbers", [] { return attributes_of_all(point_numbers); });
  module.def("axis_units", [](const std::string& key) { return SliceAxis{key}.angle() ? "radian" : "1"; });
  bind_kept<BasinSlice>(module, "Map", &result_text<BasinSlice>)
      .def("arrays", made<BasinSlice>(&arrays_of_map))
      .def("summary", made<BasinSlice>(&summary_of_map))
      .def("page", paged<BasinSlice>())
      .def("save", saved<BasinSlice>(&write_map_file));
  module.def("map", &draw_map);
  bind_kept<StabilityPlane>(module, "Stability", &result_text<StabilityPlane>)
      .def("arrays", made<StabilityPlane>(&arrays_of_stability))
      .def("summary", made<StabilityPlane>(&summary_of_stability))
      .def("csv", made<StabilityPlane>(&stability_csv))
      .def("save", saved<StabilityPlane>(&write_stability_file));
  module.def("stability", &look_at_balance);
  bind_kept<BifurcationChart>(module, "Chart", &result_text<BifurcationChart>)
      .def("csv", made<BifurcationChart>(&chart_csv))
      .def("save", saved<BifurcationChart>(&write_chart_file));
  module.def("chart", &draw_chart);
}

}  // namespace equipoise::python
