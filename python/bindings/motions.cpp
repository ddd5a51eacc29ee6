// Attractors, branches of them, proofs.
#include <complex>

#include <pybind11/complex.h>
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/extras/cycles/motion_branch.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/report/reports/reports.hpp"
#include "equipoise/report/shown/motion_path.hpp"
#include "equipoise/results/result_files/branches_file.hpp"

namespace equipoise::python {

namespace {

// Additional states to follow, each like Attractor.state without what a motor adds.
std::vector<std::vector<double>> seeds_from(const Study& study, const std::optional<py::array>& states) {
  if (!states) return {};
  return rows_from(*states, static_cast<std::size_t>(model::dimension(study.parameters.balls)), "states",
                   "x, y, u, v, ball angles, ball rates");
}

Kept<AttractorsResult> find_attractors(const PyStudy& s, std::optional<std::uint64_t> starts,
                                       const std::optional<py::array>& states, const py::dict& settings) {
  const Study study = with_medians(s.study);
  CallWith<AttractorsOptions> call(settings);
  if (starts) call.options.starts = *starts;
  call.options.warm_start_states = seeds_from(study, states);
  return call.keep([&] { return attractors(study, call.options); });
}

// A stretch of the motion that the state lies on: centre in the room's axes, balls as seen from the rotor.
py::dict path_of(const PyStudy& s, const std::vector<double>& state, double duration, int count,
                 const py::dict& settings) {
  const Study study = with_medians(s.study);
  Motion motion;
  motion.state = Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
  CallWith<> call(settings);
  MotionPath path = Call::run([&] { return motion_path(study.system(), motion, duration, count, call.options); });
  const py::array_t<double> phi = columns_of(path.phi, path.x.size());
  return py::dict("interrupted"_a = call.interrupted(), "phi"_a = phi, "psi"_a = array_of(std::move(path.psi)),
                  "X"_a = array_of(std::move(path.x)), "Y"_a = array_of(std::move(path.y)));
}

Kept<BranchesResult> follow(const PyStudy& s, const std::string& along, std::uint64_t starts,
                            const std::optional<py::array>& states, const py::dict& settings) {
  const Study study = with_medians(s.study);
  const ParameterLine line(study, along);
  CallWith<ContinuationOptions> call(settings);
  call.options.starts = starts;
  call.options.warm_start_states = seeds_from(study, states);
  return call.keep([&] { return follow_attractors(study, line, call.options); });
}

// One motion along a parameter: columns over the points of the branch, in the order of the curve.
py::dict follow_one(const PyStudy& s, const std::vector<double>& state, const std::string& key, double at, double to,
                    const py::dict& settings) {
  const Study study = with_medians(s.study);
  CallWith<> call(settings);
  const Eigen::VectorXd from = Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
  const MotionBranch found = Call::run([&] { return follow_motion(study, key, at, to, from, call.options); });
  const std::vector<BranchPoint>& points = found.branch.points;
  const auto count = static_cast<py::ssize_t>(points.size());
  const auto column = [&](const auto& of) {
    py::array_t<double> values(count);
    for (py::ssize_t k = 0; k < count; ++k) values.mutable_at(k) = of(points[static_cast<std::size_t>(k)].motion);
    return values;
  };
  const auto table = [&]<class T>(T, py::ssize_t width, const auto& of) {
    py::array_t<T> values({count, width});
    for (py::ssize_t k = 0; k < count; ++k)
      for (py::ssize_t i = 0; i < width; ++i)
        values.mutable_at(k, i) = of(points[static_cast<std::size_t>(k)].motion, static_cast<std::size_t>(i));
    return values;
  };
  const py::ssize_t size = points.empty() ? 0 : points.front().motion.state.size();
  const py::ssize_t spectrum = points.empty() ? 0 : points.front().motion.spectrum.size();
  py::array_t<double> value(count);
  for (py::ssize_t k = 0; k < count; ++k) value.mutable_at(k) = points[static_cast<std::size_t>(k)].value;
  py::list kinds, events;
  for (const BranchPoint& point : points) kinds.append(name_of(point.motion.kind));
  for (const BranchEvent& e : found.branch.events)
    events.append(py::dict("change"_a = name_of(e.change), "cause"_a = name_of(e.cause), "low"_a = e.low,
                           "high"_a = e.high, "r_min"_a = e.r_min, "r_mean"_a = e.r_mean, "r_max"_a = e.r_max));
  return py::dict(
      "interrupted"_a = call.interrupted(), "end"_a = name_of(found.end), "id"_a = found.branch.id,
      "name"_a = found.branch.name, "alias"_a = found.branch.alias, "kind"_a = kinds, "events"_a = events,
      "value"_a = value, "stable"_a = column([](const Motion& m) { return m.stable; }),
      "r_min"_a = column([](const Motion& m) { return m.r_min; }),
      "r_mean"_a = column([](const Motion& m) { return m.r_mean; }),
      "r_max"_a = column([](const Motion& m) { return m.r_max; }),
      "period"_a = column([](const Motion& m) { return m.kind == MotionKind::periodic ? m.period : no_number; }),
      "growth_rate"_a = column([](const Motion& m) { return growth_rate(m); }),
      "multiplier"_a = column([](const Motion& m) { return largest_multiplier(m); }),
      "drift"_a = table(0.0, study.parameters.balls, [](const Motion& m, std::size_t i) { return m.drift[i]; }),
      "state"_a =
          table(0.0, size, [](const Motion& m, std::size_t i) { return m.state[static_cast<Eigen::Index>(i)]; }),
      "spectrum"_a = table(std::complex<double>(), spectrum,
                           [](const Motion& m, std::size_t i) { return m.spectrum[static_cast<Eigen::Index>(i)]; }));
}

Kept<CertifyResult> prove(const PyStudy& s, const py::dict& settings) {
  const Study study = with_medians(s.study);
  CallWith<> call(settings);
  return call.keep([&] { return certify(study, call.options); });
}

Kept<CertificateFile> check(const std::string& text, const std::string& where) {
  return {Call::run([&] { return checked_certificates(text, where); })};
}

}  // namespace

void bind_motions(py::module_& module) {
  bind_kept<AttractorsResult>(module, "Attractors", &result_text<AttractorsResult>);
  module.def("attractors", &find_attractors);
  module.def("motion_path", &path_of);
  bind_kept<BranchesResult>(module, "Branches", &result_text<BranchesResult>)
      .def("csv", made<BranchesResult>(&branches_csv))
      .def("save", saved<BranchesResult>(&write_branches_file));
  module.def("follow", &follow);
  module.def("follow_one", &follow_one);
  bind_kept<CertifyResult>(module, "Certificates", &certify_text).def("certificates", [](const Kept<CertifyResult>& c) {
    return certificates_json(c.result);
  });
  module.def("certify", &prove);
  bind_kept<CertificateFile>(module, "CertificateFile", &check_text);
  module.def("check_certificates", &check);
}

}  // namespace equipoise::python
