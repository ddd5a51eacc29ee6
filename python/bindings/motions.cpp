// Attractors, branches of them, proofs.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "convert.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
#include "equipoise/extras/proof/certify.hpp"
#include "equipoise/analyses/continuation/continuation.hpp"
#include "equipoise/report/reports/attractors_report.hpp"
#include "equipoise/report/reports/branches_report.hpp"
#include "equipoise/extras/proof/certify_report.hpp"
#include "equipoise/report/shown/motion_path.hpp"
#include "equipoise/results/result_files/branches_file.hpp"
#include "kept.hpp"
#include "py_study.hpp"

namespace equipoise::python {

namespace {

// States to follow besides, each as Attractor.state has it without what a motor adds.
std::vector<std::vector<double>> seeds_from(const Study& study, const std::optional<py::array>& states) {
  if (!states) return {};
  return rows_from(*states, static_cast<std::size_t>(model::dimension(study.parameters.balls)), "states",
                   "x, y, u, v, ball angles, ball rates");
}

Kept<AttractorsResult> find_attractors(const PyStudy& s, std::optional<std::uint64_t> starts,
                                       const std::optional<py::array>& states, const py::dict& settings) {
  const Study study = with_medians(s.study);
  Call call(settings);
  AttractorsOptions options;
  call.set(options);
  if (starts) options.starts = *starts;
  options.warm_start_states = seeds_from(study, states);
  AttractorsResult result = Call::run([&] { return attractors(study, options); });
  return {std::move(result), call.interrupted()};
}

// A stretch of the motion that the state lies on: centre in the room's axes, balls as seen from the rotor.
py::dict path_of(const PyStudy& s, const std::vector<double>& state, double duration, int count,
                 const py::dict& settings) {
  const Study study = with_medians(s.study);
  Motion motion;
  motion.state = Eigen::Map<const Eigen::VectorXd>(state.data(), static_cast<Eigen::Index>(state.size()));
  Call call(settings);
  RunOptions options;
  call.set(options);
  MotionPath path = Call::run([&] { return motion_path(study.system(), motion, duration, count, options); });
  py::dict result;
  result["interrupted"] = call.interrupted();
  const std::size_t rows = path.x.size();
  result["phi"] = columns_of(path.phi, rows);
  result["psi"] = array_of(std::move(path.psi));
  result["X"] = array_of(std::move(path.x));
  result["Y"] = array_of(std::move(path.y));
  return result;
}

using Branches = Kept<BranchesResult>;

Branches follow(const PyStudy& s, const std::string& along, std::uint64_t starts,
                const std::optional<py::array>& states, const py::dict& settings) {
  const Study study = with_medians(s.study);
  const ParameterLine line(study, along);
  Call call(settings);
  ContinuationOptions options;
  call.set(options);
  options.starts = starts;
  options.warm_start_states = seeds_from(study, states);
  BranchesResult result = Call::run([&] { return follow_attractors(study, line, options); });
  return {std::move(result), call.interrupted()};
}

Kept<CertifyResult> prove(const PyStudy& s, const py::dict& settings) {
  const Study study = with_medians(s.study);
  Call call(settings);
  RunOptions options;
  call.set(options);
  CertifyResult result = Call::run([&] { return certify(study, options); });
  return {std::move(result), call.interrupted()};
}

}  // namespace

void bind_motions(py::module_& module) {
  bind_kept<AttractorsResult>(module, "Attractors", &attractors_text, &attractors_json);
  module.def("attractors", &find_attractors, py::arg("study"), py::arg("starts"), py::arg("states"),
             py::arg("settings"));
  module.def("motion_path", &path_of, py::arg("study"), py::arg("state"), py::arg("duration"), py::arg("count"),
             py::arg("settings"));
  bind_kept<BranchesResult>(module, "Branches", &branches_text, &branches_json)
      .def("csv", [](const Branches& b) { return branches_csv(b.result); })
      .def("save", [](const Branches& b, const std::string& path) { write_branches_file(path, b.result); });
  module.def("follow", &follow, py::arg("study"), py::arg("along"), py::arg("starts"), py::arg("states"),
             py::arg("settings"));
  bind_kept<CertifyResult>(module, "Certificates", &certify_text, &certify_json)
      .def("certificates", [](const Kept<CertifyResult>& c) { return certificates_json(c.result); });
  module.def("certify", &prove, py::arg("study"), py::arg("settings"));
}

}  // namespace equipoise::python
