// Headers and starts of ensembles' files.
#include "equipoise/analyses/ensembles/stored_ensemble.hpp"

#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/classification/rotor_family/horizon.hpp"
#include "equipoise/classification/start_runs/checks.hpp"
#include "equipoise/classification/start_runs/transient_tally.hpp"
#include "equipoise/core/base/error.hpp"
#include "equipoise/machine/model/state_layout.hpp"
#include "equipoise/results/commands/left_grade.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/simulation/kernels/batch_kernels.hpp"
#include "equipoise/simulation/spin_up/initial_state.hpp"

namespace equipoise {

namespace {

// Whether dry friction may hold balls, in the study or for values that its starts may draw.
bool balls_may_stick(const Study& study) {
  const auto drawn = [](const UncertainValue& v) {
    return v.key == "balancer.rolling" || v.key == "balancer.stiction";
  };
  const auto& values = study.uncertain.values;
  return study.parameters.balls_stick() || std::any_of(values.begin(), values.end(), drawn);
}

}  // namespace

BasinFileHeader basin_file_header(const Study& study, bool angles, bool transients, const std::string& given_starts,
                                  const std::string& target) {
  Study identity = with_horizon(study);  // everything that decides the outcome of start i
  const Sampler sampler = sampler_of(study);
  identity.sampling.starts = sampler.grid() ? sampler.grid()->starts() : 1;
  BasinFileHeader header;
  header.study = to_toml(identity);
  header.balls = study.parameters.balls;
  header.cpu_target = target;
  header.arithmetic = cpu_arithmetic(target);
  header.angles = angles;
  header.driven = study.speed.driven();
  header.touches = study.parameters.balls_collide();
  header.sticks = balls_may_stick(study);
  for (const model::StateVariable& v : model::state_variables(study.system().layout()))
    header.variables.push_back(v.name);
  for (const UncertainValue& value : study.uncertain.values) {
    header.drawn.push_back(value.key);
    header.drawn_units.push_back(value.unit.empty() ? "1" : value.unit);
  }
  header.full_starts = !study.sampling.box.empty() || !given_starts.empty();
  header.own_starts = given_starts;
  header.method = sampler.method();
  header.scales = study.scales;
  if (transients) header.transients = transient_settings(study);
  return header;
}

void add_start(const Study& study, const Sampler& sampler, std::uint64_t index, const InitialState& s, bool own,
               const Outcome& outcome, const TransientRow* row, StartArrays& arrays) {
  ++arrays.starts;
  const int balls = arrays.balls = study.parameters.balls;
  arrays.phi.insert(arrays.phi.end(), s.phi.begin(), s.phi.begin() + balls);
  if (own) arrays.psi.push_back(s.psi);
  if (own || !study.sampling.box.empty()) {
    arrays.rotor_state.insert(arrays.rotor_state.end(), {s.x, s.y, s.x_dot, s.y_dot});
    arrays.phi_dot.insert(arrays.phi_dot.end(), s.phi_dot.begin(), s.phi_dot.begin() + balls);
  }
  const std::vector<double> drawn = drawn_values(study, sampler, study.sampling.seed, index);
  arrays.drawn.insert(arrays.drawn.end(), drawn.begin(), drawn.end());
  if (sampler.grid()) arrays.weight.push_back(sampler.weight(study.sampling.seed, index));
  arrays.outcome.push_back(code_of(outcome));
  arrays.decision_time.push_back(outcome.time);
  arrays.decided_by.push_back(static_cast<signed char>(outcome.by));
  if (study.speed.driven()) arrays.mean_speed.push_back(outcome.mean_speed);
  if (balls_may_stick(study)) arrays.left_unbalance.push_back(outcome.unbalance);
  if (study.parameters.balls_collide()) arrays.balls_met.push_back(outcome.met);
  if (row)
    for (std::size_t k = 0; k < transient_figures.size(); ++k)
      arrays.transients[k].push_back(row->*transient_figures[k].value);
}

namespace {

bool same(const Outcome& a, const Outcome& b) {
  return a.kind == b.kind && a.attractor == b.attractor && a.by == b.by && a.time == b.time;
}

}  // namespace

// A few are enough: if arithmetic differs, so do most starts' decision times.
void check_stored(const BasinFile& file, const std::string& path, std::uint64_t stored, const std::string& target,
                  const std::function<bool(Chunk&)>& decide) {
  const auto& targets = file.cpu_targets();
  const bool known = std::find(targets.begin(), targets.end(), target) != targets.end();
  const std::uint64_t each = std::min<std::uint64_t>(known ? 4 : 64, stored);
  for (const std::uint64_t first : {std::uint64_t{0}, stored - each}) {
    Chunk chunk;
    chunk.first = first;
    chunk.count = each;
    if (!decide(chunk)) return;
    const StartArrays starts = file.read(first, each);
    for (std::size_t i = 0; i < each; ++i)
      if (!same(*outcome_of(starts, i), chunk.outcomes[i]))
        throw InputError(path, "", "",
                         fmt::format("start {}, computed with {}, has another result in this program with {}; must be "
                                     "a new file, or one that this program and instruction set made",
                                     first + i, fmt::join(targets, ", "), target));
  }
}

void append_starts(BasinFile& file, const Study& study, const Sampler& sampler, const Chunk& chunk,
                   std::pair<std::size_t, std::size_t> part, bool own,
                   const std::function<InitialState(std::uint64_t)>& start_of, const RunTime& so_far) {
  const bool whole = own || !study.sampling.box.empty();
  const auto balls = static_cast<std::size_t>(study.parameters.balls);
  StartArrays starts;
  for (std::size_t i = part.first; i < part.second; ++i) {
    InitialState s = whole ? start_of(chunk.first + i) : InitialState{};
    std::copy_n(chunk.phi.data() + i * balls, balls, s.phi.begin());
    add_start(study, sampler, chunk.first + i, s, own, chunk.outcomes[i], chunk.row(i), starts);
  }
  file.append(starts, so_far);
}

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
