// Wright and Peng (2019): its studies, and all of it computed again.
#include <algorithm>

#include <pybind11/stl.h>

#include "bindings.hpp"
#include "equipoise/extras/reproduction/reproduction.hpp"
#include "equipoise/paper.hpp"
#include "equipoise/report/drawing/document.hpp"
#include "equipoise/report/text/table_text.hpp"

namespace equipoise::python {

namespace {

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

Kept<Reproduction> run_reproduce(const std::vector<std::string>& what, std::uint64_t starts, const std::string& law,
                                 const std::string& folder, int slice_pixels, const std::string& command,
                                 const py::dict& settings) {
  CallWith<ReproduceOptions> call(settings, options_for(what));
  call.options.starts = starts;
  call.options.folder = folder;
  call.options.slice_pixels = slice_pixels;
  const auto chosen = std::find(law_choice_names.begin(), law_choice_names.end(), law);
  if (chosen == law_choice_names.end())
    throw InputError("law", "", law, "must be \"published\", \"kinematic\" or \"both\"");
  call.options.laws = static_cast<LawChoice>(chosen - law_choice_names.begin());
  Kept<Reproduction> kept = call.keep([&] { return reproduce(call.options); });
  kept.result.command = command;
  return kept;
}

}  // namespace

void bind_paper(py::module_& module) {
  module.def("paper_studies", &study_names);
  module.def("paper_study", &paper_study);
  module.def("reproducible", &reproducible);
  const auto text = [](const Reproduction& r) { return document_text(reproduction_document(r), wide_style); };
  bind_kept<Reproduction>(module, "Reproduction", text)
      .def("page", [](const Kept<Reproduction>& kept, const std::string& explorer) {
        return document_html(reproduction_document(kept.result, explorer));
      });
  module.def("reproduce", &run_reproduce);
}

}  // namespace equipoise::python
