// Attractors, branches of them, proofs.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "convert.hpp"
#include "equipoise/analyses/one_study/attractors.hpp"
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
  bind_kept<CertifyResult>(module, "Certificates", &certify_text).def("certificates", [](const Kept<CertifyResult>& c) {
    return certificates_json(c.result);
  });
  module.def("certify", &prove);
  bind_kept<CertificateFile>(module, "CertificateFile", &check_text);
  module.def("check_certificates", &check);
}

}  // namespace equipoise::python
