// Outcomes in files of results.
#include "equipoise/results/result_files/basin_outcomes.hpp"

#include <cstddef>
#include <limits>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/io/sealed_file.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace io {

std::size_t add_outcome_kinds(Dataset& data, const std::string& before, const std::vector<OutcomeShare>& kinds) {
  const std::size_t kind = data.dimension("outcome_kind", kinds.size());
  const auto code = [&kinds](std::size_t k) { return kinds[k].id; };
  data.add(before + "code", "1", "value of outcome", {kind}, code, DataColumn::Type::small);
  data.add_texts(before + "name", kind, kinds, &OutcomeShare::name, words::files::name_of_outcome);
  data.add_texts(before + "alias", kind, kinds, &OutcomeShare::alias, words::files::name_by_wright_and_peng);
  return kind;
}

std::vector<OutcomeShare> read_outcome_kinds(const NetcdfFile& file, const std::string& before) {
  std::vector<short> codes(file.length("outcome_kind"));
  const int variable = file.variable(before + "code", netcdf_type(DataColumn::Type::small), {codes.size()});
  file.read(variable, {0}, {codes.size()}, codes.data());
  std::vector<OutcomeShare> kinds;
  for (std::size_t k = 0; k < codes.size(); ++k)
    kinds.push_back({codes[k], file.read_text(before + "name", k), file.read_text(before + "alias", k)});
  return kinds;
}

void add_outcome_flags(DataColumn& column, const std::vector<OutcomeShare>& kinds) {
  std::string meanings;
  for (const OutcomeShare& o : kinds) {
    column.flags.push_back(o.id);
    meanings += (meanings.empty() ? "" : " ") + flag_word(o.name);
  }
  column.attributes.emplace_back("flag_meanings", meanings);
}

}  // namespace io

BasinOutcomes read_basin_outcomes(const std::string& path) {
  if (const std::string problem = io::why_not_whole(path); !problem.empty())
    throw InputError(path, "", "", fmt::format(words::files::finished_basin, problem));
  const io::NetcdfFile file(path, io::NetcdfFile::Mode::read);
  const std::size_t starts = file.length("start"), kinds = file.length("outcome_kind");
  if (starts == 0 || kinds == 0)
    throw InputError(path, "", "", fmt::format(words::files::finished_basin, words::files::no_starts));
  BasinOutcomes result;
  result.study = parse_kept_study(file.attribute("study"), path);
  result.partial = file.attribute("complete") != "yes";
  result.own_starts = file.attribute("own_starts");
  result.outcome.resize(starts);
  file.read(file.variable("outcome", NC_SHORT, {starts}), {0}, {starts}, result.outcome.data());
  if (file.has_variable("mean_speed")) {
    result.mean_speed.resize(starts);
    file.read(file.variable("mean_speed", NC_FLOAT, {starts}), {0}, {starts}, result.mean_speed.data());
    for (float& speed : result.mean_speed)
      if (speed == io::missing_figure) speed = std::numeric_limits<float>::quiet_NaN();
  }
  std::vector<bool> lost(starts);
  for (std::size_t k = 0; k < transient_figures.size(); ++k) {
    const TransientFigure& f = transient_figures[k];
    if (!file.has_variable(f.name)) continue;
    std::vector<float>& values = result.transients[k];
    values.resize(starts);
    file.read(file.variable(f.name, NC_FLOAT, {starts}), {0}, {starts}, values.data());
    for (std::size_t i = 0; i < starts; ++i) {
      const bool missing = values[i] == io::missing_figure;
      if (k == 0) lost[i] = missing;  // of every start that was not lost there is a peak
      if (missing)
        values[i] =
            f.needs && !lost[i] ? std::numeric_limits<float>::infinity() : std::numeric_limits<float>::quiet_NaN();
    }
  }
  for (const OutcomeShare& o : io::read_outcome_kinds(file, "kind_"))
    result.names[static_cast<short>(o.id)] = {o.name, o.alias};
  for (std::size_t i = 0; i < starts; ++i)
    if (!result.names.contains(result.outcome[i]))
      throw InputError(path, "", "", fmt::format(words::files::outcome_without_name, i, result.outcome[i]));
  return result;
}

}  // namespace equipoise
