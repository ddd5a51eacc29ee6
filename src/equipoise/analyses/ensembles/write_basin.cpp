// Writes the arrays of a result as the columns of a file.
#include "equipoise/analyses/ensembles/write_basin.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>

#include <fmt/format.h>

#include "equipoise/analyses/ensembles/basin.hpp"
#include "equipoise/analyses/ensembles/basin_header.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/result_files/start_columns.hpp"

namespace equipoise {

namespace {

// From arrays that hold starts with whole states.
std::vector<InitialState> initial_states(const StartArrays& a) {
  const std::size_t balls = static_cast<std::size_t>(a.balls);
  std::vector<InitialState> starts(a.starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    InitialState& s = starts[i];
    const double* rotor = &a.rotor_state[4 * i];
    s.psi = a.psi[i];
    s.x = rotor[0], s.y = rotor[1], s.x_dot = rotor[2], s.y_dot = rotor[3];
    for (std::size_t k = 0; k < balls; ++k) {
      s.phi[k] = a.phi[balls * i + k];
      s.phi_dot[k] = a.phi_dot[balls * i + k];
    }
  }
  return starts;
}

// `given`: checksum of the caller's starts.
BasinFileHeader header_of(const BasinResult& result, const std::string& given) {
  return basin_file_header(result.study, true, result.transients.has_value(), given, result.cpu_target);
}

void check_whole(const BasinResult& result) {
  const std::uint64_t kept = result.every_start ? result.every_start->starts : 0;
  if (result.starts == 0 || kept != result.starts)
    throw InputError("basin file", "every_start", fmt::format("{}", kept),
                     fmt::format("of {} starts; must be all (keep_starts), and one or more", result.starts));
}

void check_outcomes(const StartArrays& a) {
  for (std::size_t i = 0; i < a.starts; ++i)
    if (!outcome_of(a, i))
      throw InputError("every_start", fmt::format("outcome[{}]", i), fmt::format("{}", a.outcome[i]),
                       "must be an outcome that basin() returned");
}

}  // namespace

std::vector<io::StartColumn> start_columns(const BasinResult& result) {
  return io::start_columns(header_of(result, result.own_starts ? "given" : ""));
}

std::vector<OutcomeShare> outcome_summary(const BasinResult& result) {
  std::vector<OutcomeShare> lines = result.attractors, others = result.others();
  for (OutcomeShare& a : lines)
    if (result.study.scales)
      for (const double u : a.unbalance) a.grade.push_back(left_balance_grade(u, result.study));
  std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.id > b.id; });
  lines.insert(lines.end(), others.begin(), others.end());
  return lines;
}

void write_basin_file(const std::string& path, const BasinResult& result) {
  check_whole(result);
  const std::string place = io::path_for_whole_results(path);
  const StartArrays& a = *result.every_start;
  const std::string given = result.own_starts ? checksum_of(result.study, initial_states(a)) : "";
  const BasinFileHeader header = header_of(result, given);
  const std::vector<io::StartColumn> columns = io::start_columns(header);
  check_outcomes(a);
  Study study = result.study;
  if (!result.partial && !result.grid) study.sampling.starts = result.starts;
  const auto values = [&](std::size_t k) -> DataValues {
    return [&a, &column = columns[k]](std::size_t at) { return column.stored(a, at); };
  };
  BasinEnd end{to_toml(study), outcome_summary(result), !result.partial, result};
  if (result.transients) end.all = result.transients->groups.front();
  end.without_balls = result.without_balls;
  io::write_netcdf_file(
      place, io::basin_dataset({end, header, result.starts, values, result.discoveries, {result.cpu_target}}));
}

}  // namespace equipoise
