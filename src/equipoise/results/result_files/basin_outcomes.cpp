// Reads outcomes from a file of results.
#include "equipoise/results/result_files/basin_outcomes.hpp"

#include <cstddef>
#include <limits>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/netcdf.hpp"
#include "equipoise/results/io/sealed_file.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

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
  const int codes = file.variable("kind_code", NC_SHORT, {kinds});
  for (std::size_t k = 0; k < kinds; ++k) {
    short code = 0;
    file.read(codes, {k}, {1}, &code);
    result.names[code] = {file.read_text("kind_name", k), file.read_text("kind_alias", k)};
  }
  for (std::size_t i = 0; i < starts; ++i)
    if (!result.names.contains(result.outcome[i]))
      throw InputError(path, "", "", fmt::format(words::files::outcome_without_name, i, result.outcome[i]));
  return result;
}

}  // namespace equipoise
