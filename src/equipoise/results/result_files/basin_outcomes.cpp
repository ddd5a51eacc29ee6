// Outcomes in files of results.
#include "equipoise/results/result_files/basin_outcomes.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/io/replacement.hpp"
#include "equipoise/results/result_files/basin_file.hpp"

namespace equipoise {

namespace {

constexpr char finished_basin[] = "{}; must be a result that \"basin -o\" finished";

}  // namespace

namespace io {

std::string fault_of_share(double share) {
  return share >= 0.0 && share <= 1.0 ? "" : fmt::format("is {} instead of a number from 0 to 1", share);
}

std::size_t add_outcome_kinds(Dataset& data, const std::string& before, const std::vector<OutcomeShare>& kinds) {
  const std::size_t kind = data.dimension("outcome_kind", kinds.size());
  const auto code = [&kinds](std::size_t k) { return kinds[k].id; };
  data.add(before + "code", "1", "value of outcome", {kind}, code, DataColumn::Type::small);
  data.add_texts(before + "name", kind, kinds, &OutcomeShare::name, "name of the outcome");
  data.add_texts(before + "alias", kind, kinds, &OutcomeShare::alias, name_by_wright_and_peng);
  return kind;
}

std::vector<OutcomeShare> read_outcome_kinds(const NetcdfFile& file, const std::string& before) {
  const auto codes = read_column(file, before + "code", DataColumn::Type::small, {file.length("outcome_kind")});
  const std::vector<double> shares = read_shares(file, before + "share");
  std::vector<OutcomeShare> kinds;
  for (std::size_t k = 0; k < codes.size(); ++k) {
    kinds.push_back(
        {static_cast<int>(codes[k]), file.read_text(before + "name", k), file.read_text(before + "alias", k)});
    kinds.back().share.share = shares[k];
  }
  return kinds;
}

std::vector<double> read_shares(const NetcdfFile& file, const std::string& name) {
  const auto shares = read_column(file, name, DataColumn::Type::real, {file.length("outcome_kind")});
  for (std::size_t k = 0; k < shares.size(); ++k)
    if (const std::string fault = fault_of_share(shares[k]); !fault.empty())
      throw RunError(fmt::format("{}: {}[{}] {}", file.name(), name, k, fault));
  return shares;
}

void require_outcomes(const NetcdfFile& file, const std::vector<OutcomeShare>& kinds) {
  constexpr std::size_t at_once = 65536;
  const std::size_t starts = file.length("start");
  const int variable = file.variable("outcome", netcdf_type(DataColumn::Type::small), {starts});
  std::vector<short> codes;
  for (std::size_t first = 0; first < starts; first += at_once) {
    codes.resize(std::min(at_once, starts - first));
    file.read(variable, {first}, {codes.size()}, codes.data());
    const auto lost = std::find_if(codes.begin(), codes.end(), [&](short code) {
      return std::none_of(kinds.begin(), kinds.end(), [code](const OutcomeShare& o) { return o.id == code; });
    });
    if (lost != codes.end())
      throw InputError(
          file.name(), "", "",
          fmt::format(outcome_without_name, first + static_cast<std::size_t>(lost - codes.begin()), *lost));
  }
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
    throw InputError(path, "", "", fmt::format(finished_basin, problem));
  const io::NetcdfFile file(path, io::NetcdfFile::Mode::read);
  const std::size_t starts = file.length("start"), kinds = file.length("outcome_kind");
  if (starts == 0 || kinds == 0) throw InputError(path, "", "", fmt::format(finished_basin, "holds no starts"));
  BasinOutcomes result;
  result.study = parse_kept_study(file.lines("study"), path);
  result.partial = file.attribute("complete") != "yes";
  result.own_starts = file.attribute("own_starts");
  BasinFileHeader holds;
  holds.angles = false;
  holds.driven = file.has_variable("mean_speed");
  holds.sticks = file.has_variable("left_unbalance");
  holds.touches = file.has_variable("balls_met");
  if (file.has_variable(transient_figures.front().name)) holds.transients.emplace();
  result.starts = starts;
  for (const io::StartColumn& c : io::start_columns(holds))
    c.take(io::read_column(file, c.name, c.type, {starts}), result);
  const std::vector<OutcomeShare> named = io::read_outcome_kinds(file, "kind_");
  io::require_outcomes(file, named);
  for (const OutcomeShare& o : named) result.names[static_cast<short>(o.id)] = {o.name, o.alias};
  return result;
}

}  // namespace equipoise
