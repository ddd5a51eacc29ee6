// Ensembles: shares, comparisons, sensitivity.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "equipoise/ensembles/basin.hpp"
#include "equipoise/analyses/comparison.hpp"
#include "equipoise/analyses/mapped_search.hpp"
#include "equipoise/analyses/sensitivity.hpp"
#include "equipoise/ensembles/write_basin.hpp"
#include "equipoise/kernels/cpu_target.hpp"
#include "equipoise/reports/basin_report.hpp"
#include "equipoise/reports/comparison_report.hpp"
#include "kept.hpp"
#include "py_study.hpp"
#include "starts.hpp"

namespace equipoise::python {

namespace {

using Basin = Kept<BasinResult>;

Basin run_basin(const PyStudy& s, double half_width, bool limit_given, std::optional<bool> transients,
                const std::string& output, bool keep, const std::optional<py::array>& initial,
                std::optional<std::uint64_t> sensitivity_rows, const Mapper* mapper, const py::dict& settings) {
  Call call(settings);
  BasinOptions options;
  call.set(options);
  options.half_width = half_width;
  options.limit_given = limit_given;
  options.transients = transients;
  options.output = output;
  options.keep_starts = keep;
  AttractorSearchCache searched;
  if (mapper) {
    const ChosenCpuTarget chosen(options.cpu_target);
    searched = mapped_search(*mapper, s.study, cpu_target());
    options.searches = &searched;
  }
  if (initial) options.initial = starts_from(s.study, *initial, "initial");
  SensitivityOptions depends;
  if (sensitivity_rows) {
    static_cast<RunOptions&>(depends) = options;
    depends.rows = *sensitivity_rows;
    check_sensitivity(s.study);
  }
  BasinResult result = Call::run([&] {
    BasinResult made = basin(s.study, options);
    if (sensitivity_rows && !made.partial) made.sensitivity = sensitivity(s.study, depends);
    return made;
  });
  return {std::move(result), call.interrupted()};
}

template <class T>
py::object column(const std::vector<T>& values, std::size_t starts) {
  if (values.empty() || starts == 0) return py::none();
  std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(starts)};
  if (const std::size_t width = values.size() / starts; width != 1) shape.push_back(static_cast<py::ssize_t>(width));
  return array_of(std::vector<T>(values), shape);
}

// Every start, if they were kept.
py::object arrays_of(const Basin& kept) {
  if (!kept.result.every_start) return py::none();
  const StartArrays& a = *kept.result.every_start;
  const auto starts = static_cast<std::size_t>(a.starts);
  py::dict arrays;
  // One ball's angles are a column of one as well.
  arrays["phi"] = array_of(std::vector<double>(a.phi), {static_cast<py::ssize_t>(starts), a.balls});
  arrays["psi"] = column(a.psi, starts);
  arrays["rotor_state"] = column(a.rotor_state, starts);
  arrays["phi_dot"] = a.phi_dot.empty()
                          ? py::object(py::none())
                          : array_of(std::vector<double>(a.phi_dot), {static_cast<py::ssize_t>(starts), a.balls});
  arrays["drawn"] = column(a.drawn, starts);
  arrays["weight"] = column(a.weight, starts);
  arrays["outcome"] = array_of(std::vector<short>(a.outcome));
  arrays["decision_time"] = array_of(std::vector<double>(a.decision_time));
  arrays["decided_by"] = array_of(std::vector<signed char>(a.decided_by));
  arrays["mean_speed"] = column(a.mean_speed, starts);
  arrays["left_unbalance"] = column(a.left_unbalance, starts);
  arrays["balls_met"] = column(a.balls_met, starts);
  py::dict transients;
  for (std::size_t k = 0; k < transient_figures.size(); ++k)
    if (!a.transients[k].empty()) transients[transient_figures[k].name] = array_of(std::vector<float>(a.transients[k]));
  arrays["transients"] = transients;
  return arrays;
}

// What is kept of every start, by name: along what it stands beside "start", and its attributes.
py::dict columns_of_starts(const Basin& kept) {
  py::dict columns;
  for (const io::StartColumn& c : start_columns(kept.result))
    columns[c.name] = py::make_tuple(c.along, attributes_of(c));
  return columns;
}

// The word of a dimension without its article: "length", "speed".
std::string word_of(study::Dimension dimension) {
  const std::string name = study::words(dimension).name;
  const std::size_t begin = name.find(' ') + 1;
  return name.substr(begin, name.find(' ', begin) - begin);
}

// In what results of a study are shown, by dimension: a unit, and what one dimensionless unit is in it.
py::dict shown_units(const PyStudy& s) {
  using study::Dimension;
  py::dict units;
  for (const Dimension d : {Dimension::length, Dimension::time, Dimension::speed, Dimension::velocity, Dimension::force,
                            Dimension::energy}) {
    const study::ShownUnit unit = study::shown_unit(d, s.study.scales);
    units[py::str(word_of(d))] = py::make_tuple(unit.name, unit.size);
  }
  return units;
}

// How the figures of transients are told; the limits that bound them, and without which they are not watched, by key.
py::list figures_of_transients() {
  py::list figures;
  for (const TransientFigure& f : transient_figures) {
    const auto bound = std::find_if(transient_limits.begin(), transient_limits.end(),
                                    [&](const TransientLimit& l) { return l.value == f.value; });
    figures.append(py::make_tuple(f.name, f.title, word_of(f.told_in()),
                                  bound == transient_limits.end() ? "" : bound->name,
                                  !f.needs                      ? ""
                                  : f.needs == &Limits::settled ? "settled"
                                                                : "displacement"));
  }
  return figures;
}

py::list grounds_of_decision() {
  py::list names;
  for (const char* name : decided_by_names) names.append(name);
  return names;
}

using Compared = Kept<ComparisonResult>;

Compared compare_studies(const PyStudy& first, const PyStudy& second, std::optional<bool> transients,
                         const py::dict& settings) {
  Call call(settings);
  RunOptions options;
  call.set(options);
  check_comparable(first.study);
  check_comparable(second.study);
  RunOptions of_first = options;
  of_first.stop_asked = [&] { return call.half_over() || options.stop_asked(); };
  ComparisonResult result = Call::run([&] {
    const bool gather = transients.value_or(first.study.limits.any() || second.study.limits.any());
    const BasinOutcomes one = basin_outcomes(first.study, of_first, gather);
    return compare(one, basin_outcomes(second.study, options, gather));
  });
  return {std::move(result), call.interrupted()};
}

}  // namespace

void bind_ensembles(py::module_& module) {
  bind_kept<BasinResult>(
      module, "Basin", [](const BasinResult& r) { return basin_text(r); },
      [](const BasinResult& r) { return basin_json(r); })
      .def("arrays", &arrays_of)
      .def("columns", &columns_of_starts)
      .def("save", [](const Basin& b, const std::string& path) { write_basin_file(path, b.result); })
      .def_property_readonly("seconds", [](const Basin& b) { return b.result.seconds; })
      .def_property_readonly("cpu_seconds", [](const Basin& b) { return b.result.cpu_seconds; });
  module.def("basin", &run_basin, py::arg("study"), py::arg("half_width"), py::arg("limit_given"),
             py::arg("transients"), py::arg("output"), py::arg("keep"), py::arg("initial"), py::arg("sensitivity_rows"),
             py::arg("mapper").none(true), py::arg("settings"));
  module.def("shown_units", &shown_units, py::arg("study"));
  module.def("figures_of_transients", &figures_of_transients);
  module.def("no_attractors", [] {
    py::dict names;
    for (const NoAttractor& n : no_attractors) names[py::int_(n.code)] = n.name;
    return names;
  });
  module.def("grounds_of_decision", &grounds_of_decision);
  bind_kept<ComparisonResult>(module, "Comparison", &comparison_text, &comparison_json)
      .def("verdict", [](const Compared& c) { return verdict(c.result); });
  module.def("compare", &compare_studies, py::arg("first"), py::arg("second"), py::arg("transients").none(true),
             py::arg("settings"));
}

}  // namespace equipoise::python
