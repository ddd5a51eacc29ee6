// Wright and Peng (2019): its studies, and all of it computed again.
#include <pybind11/stl.h>

#include "bindings.hpp"
#include "call.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/extras/reproduction/reproduction_document.hpp"
#include "equipoise/paper.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "kept.hpp"
#include "py_study.hpp"

namespace equipoise::python {

namespace {

using Reproduced = Kept<Reproduction>;

std::vector<std::string> study_names() {
  std::vector<std::string> names;
  for (const PublishedTable& table : published_tables())
    for (const PublishedRow& row : table.rows) names.push_back(row.study);
  return names;
}

PyStudy paper_study(const std::string& name, const std::string& law) {
  const auto chosen = law == "published" ? model::SpeedLaw::published : model::SpeedLaw::kinematic;
  if (law != "published" && law != "kinematic")
    throw InputError("law", "", law, "must be \"kinematic\" or \"published\"");
  for (const PublishedTable& table : published_tables())
    for (const PublishedRow& row : table.rows)
      if (row.study == name) return PyStudy({to_toml(study_of(row, chosen)), name, {}});
  throw InputError("name", "", name, "must be one of paper_studies()");
}

Reproduced run_reproduce(const std::vector<std::string>& what, std::uint64_t starts, const std::string& law,
                         const std::string& folder, int slice_pixels, const std::string& command,
                         const py::dict& settings) {
  Call call(settings);
  ReproduceOptions options = options_for(what);
  call.set(options);
  options.starts = starts;
  options.folder = folder;
  options.slice_pixels = slice_pixels;
  bool known = false;
  for (std::size_t k = 0; k < law_choice_names.size(); ++k)
    if (law == law_choice_names[k]) {
      options.laws = static_cast<LawChoice>(k);
      known = true;
    }
  if (!known) throw InputError("law", "", law, "must be \"published\", \"kinematic\" or \"both\"");
  Reproduction result = Call::run([&] { return reproduce(options); });
  result.command = command;
  return {std::move(result), call.interrupted()};
}

}  // namespace

void bind_paper(py::module_& module) {
  module.def("paper_studies", &study_names);
  module.def("paper_study", &paper_study, py::arg("name"), py::arg("law"));
  module.def("reproducible", &reproducible);
  bind_kept<Reproduction>(module, "Reproduction", &reproduction_text, &reproduction_json)
      .def(
          "page",
          [](const Reproduced& kept, const std::string& explorer) {
            return document_html(reproduction_document(kept.result, explorer));
          },
          py::arg("explorer"));
  module.def("reproduce", &run_reproduce, py::arg("what"), py::arg("starts"), py::arg("law"), py::arg("folder"),
             py::arg("map_pixels"), py::arg("command"), py::arg("settings"));
}

}  // namespace equipoise::python
