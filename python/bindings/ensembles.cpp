// Ensembles: shares, comparisons, sensitivity.
#include <array>
#include <optional>
#include <variant>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/report/answers/answer.hpp"
#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/one_study/comparison.hpp"
#include "equipoise/analyses/mapper/mapper.hpp"
#include "equipoise/analyses/one_study/sensitivity.hpp"
#include "equipoise/classification/attractor_search/attractor_search.hpp"
#include "equipoise/core/statistics/share.hpp"
#include "equipoise/report/decision/verdict.hpp"
#include "equipoise/analyses/ensembles/write_basin.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/simulation/kernels/cpu_target.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/shown/machine_page.hpp"

namespace equipoise::python {

namespace {

/// An ensemble, what changes were tried on it, and what its page says.
struct JudgedBasin {
  BasinResult basin;
  std::vector<TriedChange> tried;
  std::string page, sentences;
};
using Basin = Kept<JudgedBasin>;

std::string json_text(const JudgedBasin& judged) { return json_text(judged.basin, judged.tried); }

// Transients are gathered where the command line gathers them.
std::optional<bool> gathered(const PyStudy& s, std::optional<bool> asked) {
  return asked || !s.study.physical ? asked : std::optional(true);
}

Basin run_basin(const PyStudy& s, double half_width, bool limit_given, std::optional<bool> transients, bool changes,
                const std::string& output, bool keep, const std::optional<py::array>& initial,
                std::optional<std::uint64_t> sensitivity_rows, const Mapper* mapper, const py::dict& settings) {
  CallWith<BasinOptions> call(settings);
  BasinOptions& options = call.options;
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
  return call.keep(
      [&] {
        JudgedBasin made{basin(s.study, options), {}, {}, {}};
        if (changes) made.tried = changes_asked_for(made.basin, options);
        if (sensitivity_rows && !made.basin.partial) made.basin.sensitivity = sensitivity(s.study, depends);
        return made;
      },
      s.source);
}

// The page for one machine, and the ensemble that it reports.
Basin run_report(const PyStudy& s, bool changes, const py::dict& settings) {
  CallWith<BasinOptions> call(settings);
  return call.keep(
      [&] {
        MachinePage page =
            machine_page(s.study, given_machine(s.source.toml, s.source.name, s.source.overrides), call.options);
        JudgedBasin made;
        if (changes) made.tried = changes_asked_for(page.basin, call.options);
        made.page = machine_html(page, made.tried);
        made.basin = std::move(page.basin);
        const auto verdict = verdict_of(made.basin, made.tried);
        made.sentences = (verdict ? verdict_text(*verdict) : "") + answer_sentence(made.basin) + "\n";
        return made;
      },
      s.source);
}

// One start by itself, as the ensemble decides it.
py::dict replay(const PyStudy& s, std::uint64_t index, std::optional<bool> transients, const py::dict& settings) {
  CallWith<BasinOptions> call(settings);
  call.options.transients = gathered(s, transients);
  const StartReplay replayed = Call::run([&] { return replay_start(s.study, index, call.options); });
  const InitialState& start = replayed.start;
  const int balls = s.study.parameters.balls;
  py::dict state = rotor_of(start), figures;
  state["phi"] = array_of(std::vector<double>(start.phi.begin(), start.phi.begin() + balls));
  state["phi_dot"] = array_of(std::vector<double>(start.phi_dot.begin(), start.phi_dot.begin() + balls));
  if (replayed.transients)
    for (const TransientFigure& f : transient_figures) figures[f.name] = (*replayed.transients).*f.value;
  const Outcome& outcome = replayed.outcome;
  return py::dict(
      "state"_a = state, "drawn"_a = array_of(std::vector<double>(replayed.drawn)),
      "outcome"_a = outcome.kind == OutcomeKind::attracted ? replayed.name : std::string(name_of(outcome.kind)),
      "decided_by"_a = decided_by_names[static_cast<std::size_t>(outcome.by)], "decision_time"_a = outcome.time,
      "mean_speed"_a = s.study.speed.driven() ? py::object(py::float_(outcome.mean_speed)) : py::none(),
      "transients"_a = figures);
}

// Every start, if they were kept. What does not apply to the study is None.
py::object arrays_of(const JudgedBasin& judged) {
  if (!judged.basin.every_start) return py::none();
  const StartArrays& a = *judged.basin.every_start;
  py::dict arrays, figures;
  for (const io::StartColumn& c : io::start_columns())
    if (!c.is_figure()) arrays[c.name] = py::none();
  for (const io::StartColumn& c : start_columns(judged.basin)) {
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(a.starts)};
    if (!c.along.empty()) shape.push_back(static_cast<py::ssize_t>(c.width));
    c.visit(a, [&](auto values) { (c.is_figure() ? figures : arrays)[c.name] = array_of(std::move(values), shape); });
  }
  arrays["transients"] = figures;
  return arrays;
}

// What is kept of every start, by name: its dimension in addition to "start", and its attributes.
py::dict columns_of_starts(const JudgedBasin& judged) {
  py::dict columns;
  for (const io::StartColumn& c : start_columns(judged.basin))
    columns[c.name] = py::make_tuple(c.along, attributes_of(c));
  return columns;
}

// The word of a dimension without its article: "length", "speed".
std::string word_of(study::Dimension dimension) {
  const std::string name = study::words(dimension).name;
  const std::size_t begin = name.find(' ') + 1;
  return name.substr(begin, name.find(' ', begin) - begin);
}

// The units in which results of a study are shown, by dimension: name, and what one dimensionless unit is in it.
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

// How the figures of transients are shown; the limits that bound them, and without which they are not watched, by key.
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

using GivenSide = std::variant<const PyStudy*, std::string>;

ComparedSide side_of(const GivenSide& given) {
  if (const auto* path = std::get_if<std::string>(&given)) return ComparedSide(*path);
  return ComparedSide(std::get<const PyStudy*>(given)->study);
}

Kept<ComparisonResult> compare_studies(const GivenSide& first_given, const GivenSide& second_given,
                                       std::optional<bool> transients, const py::dict& settings) {
  CallWith<> call(settings);
  const ComparedSide first = side_of(first_given), second = side_of(second_given);
  RunOptions of_first = call.options;
  if (second.study) of_first.stop_asked = [&] { return call.half_over() || call.options.stop_asked(); };
  return call.keep([&] { return compare(first, second, of_first, call.options, transients); });
}

}  // namespace

void bind_ensembles(py::module_& module) {
  bind_kept<JudgedBasin>(module, "Basin", [](const JudgedBasin& r) { return basin_text(r.basin, wide_style, r.tried); })
      .def("page", [](const Basin& b) { return b.result.page; })
      .def("sentences", [](const Basin& b) { return b.result.sentences; })
      .def("arrays", made<JudgedBasin>(&arrays_of))
      .def("columns", made<JudgedBasin>(&columns_of_starts))
      .def("save", [](const Basin& b, const std::string& path) { write_basin_file(path, b.result.basin); })
      .def_property_readonly("seconds", [](const Basin& b) { return b.result.basin.seconds; })
      .def_property_readonly("cpu_seconds", [](const Basin& b) { return b.result.basin.cpu_seconds; });
  module.def("basin", &run_basin);
  module.def("replay", &replay);
  module.def("report", &run_report);
  module.def("shown_units", &shown_units);
  module.def("figures_of_transients", &figures_of_transients);
  module.def("no_attractors", [] {
    py::dict names;
    for (const NoAttractor& n : no_attractors) names[py::int_(n.code)] = n.name;
    return names;
  });
  module.def("grounds_of_decision",
             [] { return std::vector<std::string>(decided_by_names.begin(), decided_by_names.end()); });
  module.def("outcome_numbers", [] {
    std::vector<std::string> names;
    for (const OutcomeNumber& n : outcome_numbers) names.emplace_back(n.name);
    return names;
  });
  module.def("flag_word", &io::flag_word);
  // share, low and high; of starts that stand for unlike cells, the sums of their weights are given, too
  module.def(
      "wilson",
      [](std::uint64_t count, std::uint64_t total, const std::optional<std::array<double, 3>>& weights) {
        const Share s = weights ? wilson_share(count, total, (*weights)[0], (*weights)[1], (*weights)[2])
                                : wilson_share(count, total);
        return std::array{s.share, s.low, s.high};
      },
      py::arg(), py::arg(), py::arg() = std::nullopt);
  bind_kept<ComparisonResult>(module, "Comparison", &result_text<ComparisonResult>)
      .def("verdict", made<ComparisonResult>(&verdict))
      .def("study", [](const Kept<ComparisonResult>& c) { return PyStudy::of(c.result.first); });
  module.def("compare", &compare_studies);
}

}  // namespace equipoise::python
