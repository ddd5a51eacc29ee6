// Files of results: what they hold, joined, and proofs checked.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "equipoise/analyses/sweeps/merge.hpp"
#include "equipoise/extras/proof/certify_report.hpp"
#include "equipoise/report/reports/inspection_report.hpp"
#include "equipoise/results/result_files/inspection.hpp"
#include "kept.hpp"
#include "py_study.hpp"

namespace equipoise::python {

namespace {

Kept<Inspection> inspect(const std::string& path) {
  const py::gil_scoped_release unlocked;
  return {inspect_file(path)};
}

Kept<SweepResult> merge(const std::vector<std::string>& files, const std::string& output) {
  const py::gil_scoped_release unlocked;
  return {merge_sweeps(files, output)};
}

Kept<CertificateFile> check(const std::string& text, const std::string& where) {
  const py::gil_scoped_release unlocked;
  return {checked_certificates(text, where)};
}

}  // namespace

void bind_files(py::module_& module) {
  bind_kept<Inspection>(module, "Inspection", &inspection_text, &inspection_json);
  module.def("inspect", &inspect, py::arg("path"));
  module.def("merge", &merge, py::arg("files"), py::arg("output"));
  bind_kept<CertificateFile>(module, "CertificateFile", &check_text, &check_json);
  module.def("check_certificates", &check, py::arg("text"), py::arg("where"));
}

}  // namespace equipoise::python
