// Ensembles: shares, comparisons, sensitivity.
#include <variant>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/analyses/mapper/mapped_search.hpp"
#include "equipoise/analyses/one_study/sensitivity.hpp"
#include "equipoise/report/decision/try_changes.hpp"
#include "equipoise/analyses/ensembles/write_basin.hpp"
#include "equipoise/report/html/given_machine.hpp"
#include "equipoise/report/html/machine_html.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/report/reports/basin_report.hpp"
#include "equipoise/report/reports/comparison_report.hpp"
#include "equipoise/report/shown/machine_page.hpp"
#include "kept.hpp"
#include "py_study.hpp"
#include "starts.hpp"

namespace equipoise::python {

namespace {

/// An ensemble, what changes were tried on it, and what its page says.
struct JudgedBasin {
  BasinResult basin;
  std::vector<TriedChange> tried;
  std::string page, sentences;
};
using Basin = Kept<JudgedBasin>;

// Transients are gathered where the command line gathers them.
std::optional<bool> gathered(const PyStudy& s, std::optional<bool> asked) {
  return asked || !s.study.physical ? asked : std::optional(true);
}

Basin run_basin(const PyStudy& s, double half_width, bool limit_given, std::optional<bool> transients, bool changes,
                const std::string& output, bool keep, const std::optional<py::array>& initial,
                std::optional<std::uint64_t> sensitivity_rows, const Mapper* mapper, const py::dict& settings) {
  Call call(settings);
  BasinOptions options;
  call.set(options);
  options.half_width = half_width;
  options.limit_given = limit_given;
  options.transients = gathered(s, transients);
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
  JudgedBasin result = Call::run([&] {
    JudgedBasin made;
    made.basin = basin(s.study, options);
    if (changes) made.tried = changes_asked_for(made.basin, options);
    if (sensitivity_rows && !made.basin.partial) made.basin.sensitivity = sensitivity(s.study, depends);
    return made;
  });
  return {std::move(result), call.interrupted(), s.source};
}

// The page for one machine, and the ensemble that it tells of.
Basin run_report(const PyStudy& s, bool changes, const py::dict& settings) {
  Call call(settings);
  BasinOptions options;
  call.set(options);
  JudgedBasin result = Call::run([&] {
    MachinePage page = machine_page(s.study, given_machine(s.source.toml, s.source.name, s.source.overrides), options);
    JudgedBasin made;
    if (changes) made.tried = changes_asked_for(page.basin, options);
    made.page = machine_html(page, made.tried);
    made.basin = std::move(page.basin);
    const auto verdict = verdict_of(made.basin, made.tried);
    made.sentences = (verdict ? verdict_text(*verdict) : "") + answer_sentence(made.basin) + "\n";
    return made;
  });
  return {std::move(result), call.interrupted(), s.source};
}

// One start by itself, as the ensemble decides it.
py::dict replay(const PyStudy& s, std::uint64_t index, std::optional<bool> transients, const py::dict& settings) {
  Call call(settings);
  BasinOptions options;
  call.set(options);
  options.transients = gathered(s, transients);
  const StartReplay replayed = Call::run([&] { return replay_start(s.study, index, options); });
  const InitialState& start = replayed.start;
  const auto balls = static_cast<std::size_t>(s.study.parameters.balls);
  py::dict result, state, figures;
  for (const auto& [name, number] :
       {std::pair{"x", start.x}, {"y", start.y}, {"x_dot", start.x_dot}, {"y_dot", start.y_dot}, {"psi", start.psi}})
    state[name] = number;
  state["phi"] = array_of(std::vector<double>(start.phi.begin(), start.phi.begin() + balls));
  state["phi_dot"] = array_of(std::vector<double>(start.phi_dot.begin(), start.phi_dot.begin() + balls));
  if (replayed.transients)
    for (const TransientFigure& f : transient_figures) figures[f.name] = (*replayed.transients).*f.value;
  const Fate& fate = replayed.fate;
  result["state"] = state;
  result["drawn"] = array_of(std::vector<double>(replayed.drawn));
  result["outcome"] = fate.outcome == Outcome::attracted ? replayed.name : std::string(name_of(fate.outcome));
  result["decided_by"] = decided_by_names[static_cast<std::size_t>(fate.by)];
  result["decision_time"] = fate.time;
  result["mean_speed"] = s.study.speed.driven() ? py::object(py::float_(fate.mean_speed)) : py::none();
  result["transients"] = figures;
  return result;
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
  if (!kept.result.basin.every_start) return py::none();
  const StartArrays& a = *kept.result.basin.every_start;
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
  for (const io::StartColumn& c : start_columns(kept.result.basin))
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

// A study, or the file of an ensemble that was finished.
struct Side {
  std::optional<BasinOutcomes> stored;
  const Study* study = nullptr;

  explicit Side(const std::variant<const PyStudy*, std::string>& given) {
    if (const auto* path = std::get_if<std::string>(&given)) {
      stored = read_basin_outcomes(*path);
    } else {
      study = &std::get<const PyStudy*>(given)->study;
      check_comparable(*study);
    }
  }
  bool has_transients() const { return study ? study->limits.any() : !stored->transients[0].empty(); }
  BasinOutcomes outcomes(const RunOptions& options, bool gather) {
    return stored ? std::move(*stored) : basin_outcomes(*study, options, gather);
  }
};

Compared compare_studies(const std::variant<const PyStudy*, std::string>& first_given,
                         const std::variant<const PyStudy*, std::string>& second_given, std::optional<bool> transients,
                         const py::dict& settings) {
  Call call(settings);
  RunOptions options;
  call.set(options);
  Side first(first_given), second(second_given);
  RunOptions of_first = options;
  if (second.study) of_first.stop_asked = [&] { return call.half_over() || options.stop_asked(); };
  ComparisonResult result = Call::run([&] {
    const bool gather = transients.value_or(first.has_transients() || second.has_transients());
    const BasinOutcomes one = first.outcomes(of_first, gather);
    return compare(one, second.outcomes(options, gather));
  });
  return {std::move(result), call.interrupted()};
}

}  // namespace

void bind_ensembles(py::module_& module) {
  bind_kept<JudgedBasin>(
      module, "Basin", [](const JudgedBasin& r) { return basin_text(r.basin, wide_style, r.tried); },
      [](const JudgedBasin& r) { return basin_json(r.basin, r.tried); })
      .def("page", [](const Basin& b) { return b.result.page; })
      .def("sentences", [](const Basin& b) { return b.result.sentences; })
      .def("arrays", &arrays_of)
      .def("columns", &columns_of_starts)
      .def("save", [](const Basin& b, const std::string& path) { write_basin_file(path, b.result.basin); })
      .def_property_readonly("seconds", [](const Basin& b) { return b.result.basin.seconds; })
      .def_property_readonly("cpu_seconds", [](const Basin& b) { return b.result.basin.cpu_seconds; });
  module.def("basin", &run_basin, py::arg("study"), py::arg("half_width"), py::arg("limit_given"),
             py::arg("transients"), py::arg("changes"), py::arg("output"), py::arg("keep"), py::arg("initial"),
             py::arg("sensitivity_rows"), py::arg("mapper").none(true), py::arg("settings"));
  module.def("replay", &replay, py::arg("study"), py::arg("index"), py::arg("transients"), py::arg("settings"));
  module.def("report", &run_report, py::arg("study"), py::arg("changes"), py::arg("settings"));
  module.def("shown_units", &shown_units, py::arg("study"));
  module.def("figures_of_transients", &figures_of_transients);
  module.def("no_attractors", [] {
    py::dict names;
    for (const NoAttractor& n : no_attractors) names[py::int_(n.code)] = n.name;
    return names;
  });
  module.def("grounds_of_decision", &grounds_of_decision);
  module.def("flag_word", &io::flag_word, py::arg("name"));
  bind_kept<ComparisonResult>(module, "Comparison", &comparison_text, &comparison_json)
      .def("verdict", [](const Compared& c) { return verdict(c.result); })
      .def("study", [](const Compared& c) {
        return PyStudy({to_toml(c.result.first), c.result.first.name, {}});
      });
  module.def("compare", &compare_studies, py::arg("first"), py::arg("second"), py::arg("transients").none(true),
             py::arg("settings"));
}

}  // namespace equipoise::python
