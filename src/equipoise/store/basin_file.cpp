// Basin results in NetCDF-4: created once, appended in index order, resumed.
#include "equipoise/store/basin_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>

#include "equipoise/base/error.hpp"
#include "equipoise/base/version.hpp"
#include "equipoise/ensemble/scrambled_sobol.hpp"
#include "equipoise/store/netcdf.hpp"

namespace equipoise {

namespace {
constexpr std::size_t chunk_length = 8192;
constexpr float missing = NC_FILL_FLOAT;

// What a file must share with a run for the run to add to it.
std::string identity(const BasinFileHeader& header) {
  const auto& asked = header.transients;
  return fmt::format("{}\n# seed {}\n# cpu target {}\n# version {}\n{}{}", header.study, header.seed, header.cpu_target,
                     version_string, header.angles ? "" : "# without angles\n",
                     asked ? fmt::format("# transients: displacement {}, settled {}, window {}\n", asked->displacement,
                                         asked->settled, asked->window)
                           : "");
}
}  // namespace

struct BasinFile::State {
  std::string path;
  std::optional<store::NetcdfFile> file;
  std::size_t balls = 2, stored = 0, discovered = 0;
  bool full_starts = false;
  SamplingMethod method = SamplingMethod::random;
  bool transients = false;
  std::array<int, transient_columns.size()> columns{};
  int weight = -1, kind_interval = -1, kind_effective = -1;
  int phi = -1, rotor = -1, phi_dot = -1, outcome = -1, time = -1, by = -1, discovery = -1;
  int kind_code = -1, kind_name = -1, kind_alias = -1, kind_count = -1, kind_share = -1, kind_low = -1, kind_high = -1;

  void create(const BasinFileHeader& header);
  void open(const BasinFileHeader& header);
  void define_full_starts(int start, int ball);
  void define_sampling(int start, int kind);
  void define_transients(int start, const BasinFileHeader& header);
  void find_variables(bool angles);
};

void BasinFile::State::define_full_starts(int start, int ball) {
  store::NetcdfFile& f = *file;
  const int component = f.dimension("rotor_component", 4);
  rotor = f.variable("rotor_state", NC_DOUBLE, {start, component}, "1",
                     "initial x, y in race radii and x_dot, y_dot, their derivatives in the rotating frame");
  phi_dot = f.variable("phi_dot", NC_DOUBLE, {start, ball}, "1",
                       "initial rate of a ball in the rotating frame, radians times omega_c");
  f.chunk(rotor, {chunk_length, 4});
  f.chunk(phi_dot, {chunk_length, balls});
}

// What differs from random starts: those alone need no more than their counts.
void BasinFile::State::define_sampling(int start, int kind) {
  store::NetcdfFile& f = *file;
  f.attribute(NC_GLOBAL, "sampling_method", sampling_method_names[static_cast<std::size_t>(method)]);
  if (method == SamplingMethod::random) return;
  kind_interval = f.variable("kind_interval", NC_STRING, {kind}, "1",
                             "where the interval is from: wilson, replicates (their spread) or pairs (of a cell)");
  kind_effective = f.variable("kind_effective_starts", NC_DOUBLE, {kind}, "1",
                              "independent random starts that have the same standard error of the share");
  if (method == SamplingMethod::sobol) {
    f.attribute(NC_GLOBAL, "sampling_replicates", fmt::format("{}", sobol_replicates));
    return;
  }
  weight = f.variable("weight", NC_DOUBLE, {start}, "1", "cells of the grid that the start's cell stands for");
  f.chunk(weight, {chunk_length});
  f.compress(weight);
}

// Dimensionless like all else; a study in physical units says what the units are worth.
void BasinFile::State::define_transients(int start, const BasinFileHeader& header) {
  store::NetcdfFile& f = *file;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    columns[k] = f.variable(transient_columns[k].name, NC_FLOAT, {start}, "1", transient_columns[k].long_name);
    f.chunk(columns[k], {chunk_length});
    f.compress(columns[k]);
    f.fill(columns[k], &missing);
  }
  const TransientSettings& asked = *header.transients;
  f.attribute(NC_GLOBAL, "transients_window", fmt::format("{}", asked.window));
  f.attribute(NC_GLOBAL, "limits_displacement", fmt::format("{}", asked.displacement));
  f.attribute(NC_GLOBAL, "limits_settled", fmt::format("{}", asked.settled));
  if (!header.scales) return;
  f.attribute(NC_GLOBAL, "unit_of_length_m", fmt::format("{}", header.scales->length));
  f.attribute(NC_GLOBAL, "unit_of_force_N", fmt::format("{}", header.scales->force()));
  f.attribute(NC_GLOBAL, "unit_of_velocity_m_per_s", fmt::format("{}", header.scales->velocity()));
  f.attribute(NC_GLOBAL, "unit_of_time_s", fmt::format("{}", header.scales->time()));
}

void BasinFile::State::create(const BasinFileHeader& header) {
  file.emplace(path, store::NetcdfFile::Mode::create);
  store::NetcdfFile& f = *file;
  const int start = f.dimension("start", store::NetcdfFile::unlimited);
  const int ball = f.dimension("ball", balls);
  const int kind = f.dimension("outcome_kind", store::NetcdfFile::unlimited);
  const int met = f.dimension("discovery", store::NetcdfFile::unlimited);
  const int component = f.dimension("component", 4 + 2 * balls);
  if (header.angles) {
    phi = f.variable("phi", NC_DOUBLE, {start, ball}, "radian",
                     "initial ball angle from the direction of the centre of mass, rotating frame");
    f.chunk(phi, {chunk_length, balls});
  }
  if (full_starts) define_full_starts(start, ball);
  define_sampling(start, kind);
  if (transients) define_transients(start, header);
  outcome = f.variable("outcome", NC_SHORT, {start}, "1",
                       "attractor that the start came to (kind_code), or 0 undecided, -1 diverged, -2 failed, "
                       "-3 stalled");
  time =
      f.variable("decision_time", NC_DOUBLE, {start}, "1", "study time at which the outcome was known, in 1/omega_c");
  by = f.variable("decided_by", NC_BYTE, {start}, "1", "grounds on which the outcome was decided");
  for (const int variable : {outcome, time, by}) {
    f.chunk(variable, {chunk_length});
    f.compress(variable);
  }
  std::vector<signed char> values;
  for (int k = 0; k < decided_by_count; ++k) values.push_back(static_cast<signed char>(k));
  f.attribute(by, "flag_values", values);
  f.attribute(by, "flag_meanings", fmt::format("{}", fmt::join(decided_by_names, " ")));
  discovery = f.variable("discovery_state", NC_DOUBLE, {met, component}, "1",
                         "state on a motion first met during the run: x, y, u, v, phi, phi_dot");
  kind_code = f.variable("kind_code", NC_SHORT, {kind}, "1", "value of outcome");
  kind_name = f.variable("kind_name", NC_STRING, {kind}, "1", "name of the outcome");
  kind_alias = f.variable("kind_alias", NC_STRING, {kind}, "1", "name that Wright and Peng (2019) give it");
  kind_count = f.variable("kind_count", NC_UINT64, {kind}, "1", "starts with the outcome");
  kind_share = f.variable("kind_share", NC_DOUBLE, {kind}, "1", "share of the starts with the outcome");
  kind_low = f.variable("kind_share_low", NC_DOUBLE, {kind}, "1", "lower end of the 95 % interval of the share");
  kind_high = f.variable("kind_share_high", NC_DOUBLE, {kind}, "1", "upper end of the 95 % interval of the share");
  f.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  f.attribute(NC_GLOBAL, "title", "Basins of a rotor with an automatic ball balancer");
  f.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
  f.attribute(NC_GLOBAL, "identity", identity(header));
  f.attribute(NC_GLOBAL, "cpu_target", header.cpu_target);
  f.attribute(NC_GLOBAL, "study", header.study);
  f.attribute(NC_GLOBAL, "complete", "no");
  f.end_definitions();
  f.sync();
}

void BasinFile::State::open(const BasinFileHeader& header) {
  try {
    file.emplace(path, store::NetcdfFile::Mode::update);
  } catch (const RunError& e) {
    throw InputError("output", "", "", fmt::format("{} (must be a new file, or results of this study)", e.what()));
  }
  if (file->attribute("identity") != identity(header)) {
    file.reset();
    throw InputError(path, "", "",
                     "holds something other than results of this study, seed, version and CPU target; must be a "
                     "new file, or results of the same study");
  }
  stored = file->length("start");
  discovered = file->length("discovery");
}

void BasinFile::State::find_variables(bool angles) {
  if (angles) phi = file->variable("phi");
  if (full_starts) rotor = file->variable("rotor_state");
  if (full_starts) phi_dot = file->variable("phi_dot");
  if (method == SamplingMethod::grid) weight = file->variable("weight");
  if (method != SamplingMethod::random) kind_interval = file->variable("kind_interval");
  if (method != SamplingMethod::random) kind_effective = file->variable("kind_effective_starts");
  for (std::size_t k = 0; transients && k < columns.size(); ++k) columns[k] = file->variable(transient_columns[k].name);
  outcome = file->variable("outcome");
  time = file->variable("decision_time");
  by = file->variable("decided_by");
  discovery = file->variable("discovery_state");
  kind_code = file->variable("kind_code");
  kind_name = file->variable("kind_name");
  kind_alias = file->variable("kind_alias");
  kind_count = file->variable("kind_count");
  kind_share = file->variable("kind_share");
  kind_low = file->variable("kind_share_low");
  kind_high = file->variable("kind_share_high");
}

BasinFile::BasinFile(const std::string& path, const BasinFileHeader& header) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->balls = static_cast<std::size_t>(header.balls);
  state_->full_starts = header.full_starts;
  state_->method = header.method;
  state_->transients = header.transients.has_value();
  if (std::filesystem::exists(path)) {
    state_->open(header);
    state_->find_variables(header.angles);
    return;
  }
  try {
    state_->create(header);
  } catch (const RunError& e) {
    throw InputError("output", "", "", fmt::format("{} (must be a file that can be written)", e.what()));
  }
}

BasinFile::~BasinFile() = default;

std::uint64_t BasinFile::stored() const { return state_->stored; }

std::vector<Fate> BasinFile::read(std::uint64_t first, std::size_t count) const {
  std::vector<short> codes(count);
  std::vector<double> times(count);
  std::vector<signed char> grounds(count);
  state_->file->read(state_->outcome, {first}, {count}, codes.data());
  state_->file->read(state_->time, {first}, {count}, times.data());
  state_->file->read(state_->by, {first}, {count}, grounds.data());
  std::vector<Fate> fates(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (codes[i] < stalled_code || grounds[i] < 0 || grounds[i] >= decided_by_count)
      throw RunError(fmt::format("{}: start {} has no valid outcome; the file is damaged", state_->path, first + i));
    fates[i].outcome = codes[i] == undecided_code  ? Outcome::undecided
                       : codes[i] == diverged_code ? Outcome::diverged
                       : codes[i] == stalled_code  ? Outcome::stalled
                       : codes[i] == failed_code   ? Outcome::failed
                                                   : Outcome::attracted;
    fates[i].attractor = std::max<short>(codes[i], 0);
    fates[i].by = static_cast<DecidedBy>(grounds[i]);
    fates[i].time = times[i];
  }
  return fates;
}

// What has no value is missing in the file: every figure of a start that was lost, the settling time of one that did
// not settle, the time above a limit of one that stays above it.
std::vector<TransientRow> BasinFile::read_transients(std::uint64_t first, std::size_t count) const {
  std::vector<TransientRow> rows(count);
  std::vector<float> values(count);
  for (std::size_t k = 0; k < transient_columns.size(); ++k) {
    const auto column = transient_columns[k].value;
    state_->file->read(state_->columns[k], {first}, {count}, values.data());
    for (std::size_t i = 0; i < count; ++i) rows[i].*column = values[i];
  }
  for (TransientRow& row : rows) {
    const bool lost = row.peak_radial == missing;
    for (const TransientColumn& column : transient_columns)
      if (lost) row.*column.value = std::numeric_limits<float>::quiet_NaN();
    for (float* endless : {&row.time_above, &row.settling_time})
      if (*endless == missing) *endless = std::numeric_limits<float>::infinity();
  }
  return rows;
}

void BasinFile::append(std::size_t count, const double* phi, const Fate* fates, const double* rotor,
                       const double* phi_dot, const double* weight, const TransientRow* rows) {
  if (count == 0) return;
  std::vector<short> codes(count);
  std::vector<double> times(count);
  std::vector<signed char> grounds(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Fate& fate = fates[i];
    codes[i] = fate.outcome == Outcome::attracted   ? fate.attractor
               : fate.outcome == Outcome::undecided ? undecided_code
               : fate.outcome == Outcome::diverged  ? diverged_code
               : fate.outcome == Outcome::stalled   ? stalled_code
                                                    : failed_code;
    times[i] = fate.time;
    grounds[i] = static_cast<signed char>(fate.by);
  }
  const std::size_t at = state_->stored;
  if (state_->phi >= 0) state_->file->write(state_->phi, {at, 0}, {count, state_->balls}, phi);
  if (state_->full_starts) {
    state_->file->write(state_->rotor, {at, 0}, {count, 4}, rotor);
    state_->file->write(state_->phi_dot, {at, 0}, {count, state_->balls}, phi_dot);
  }
  if (state_->weight >= 0) state_->file->write(state_->weight, {at}, {count}, weight);
  std::vector<float> values(count);
  for (std::size_t k = 0; rows && state_->transients && k < transient_columns.size(); ++k) {
    for (std::size_t i = 0; i < count; ++i) {
      const float value = rows[i].*transient_columns[k].value;
      values[i] = std::isfinite(value) ? value : missing;
    }
    state_->file->write(state_->columns[k], {at}, {count}, values.data());
  }
  state_->file->write(state_->outcome, {at}, {count}, codes.data());
  state_->file->write(state_->time, {at}, {count}, times.data());
  state_->file->write(state_->by, {at}, {count}, grounds.data());
  state_->stored += count;
}

std::vector<std::vector<double>> BasinFile::discoveries() const {
  const std::size_t size = 4 + 2 * state_->balls;
  std::vector<std::vector<double>> result(state_->discovered, std::vector<double>(size));
  for (std::size_t k = 0; k < result.size(); ++k)
    state_->file->read(state_->discovery, {k, 0}, {1, size}, result[k].data());
  return result;
}

void BasinFile::append_discovery(const std::vector<double>& state) {
  state_->file->write(state_->discovery, {state_->discovered, 0}, {1, state.size()}, state.data());
  ++state_->discovered;
}

void BasinFile::sync() { state_->file->sync(); }

bool BasinFile::complete() const { return state_->file->attribute("complete") == "yes"; }

// What a count does not tell.
void BasinFile::read_share(std::size_t k, Share& share) const {
  const store::NetcdfFile& f = *state_->file;
  f.read(state_->kind_share, {k}, {1}, &share.share);
  f.read(state_->kind_low, {k}, {1}, &share.low);
  f.read(state_->kind_high, {k}, {1}, &share.high);
  f.read(state_->kind_effective, {k}, {1}, &share.effective_starts);
  const std::string by = f.read_string(state_->kind_interval, k);
  share.by =
      static_cast<IntervalBy>(std::find(interval_names.begin(), interval_names.end(), by) - interval_names.begin());
  share.standard_error =
      share.effective_starts > 0.0 ? std::sqrt(share.share * (1.0 - share.share) / share.effective_starts) : 0.0;
}

std::vector<OutcomeSummary> BasinFile::summary() const {
  const store::NetcdfFile& f = *state_->file;
  std::vector<OutcomeSummary> lines(f.length("outcome_kind"));
  for (std::size_t k = 0; k < lines.size(); ++k) {
    OutcomeSummary& s = lines[k];
    short code = 0;
    unsigned long long count = 0;
    f.read(state_->kind_code, {k}, {1}, &code);
    f.read(state_->kind_count, {k}, {1}, &count);
    s.code = code;
    s.name = f.read_string(state_->kind_name, k);
    s.alias = f.read_string(state_->kind_alias, k);
    s.share = wilson_share(count, state_->stored);
    if (state_->method != SamplingMethod::random) read_share(k, s.share);
  }
  return lines;
}

RunTime BasinFile::time() const {
  const auto number = [&](const char* name) { return std::strtod(state_->file->attribute(name).c_str(), nullptr); };
  return {number("seconds"), number("cpu_seconds")};
}

void BasinFile::finish(const std::string& resolved_study, const std::vector<OutcomeSummary>& summary, bool complete,
                       const RunTime& time) {
  store::NetcdfFile& f = *state_->file;
  for (std::size_t k = 0; k < summary.size(); ++k) {
    const OutcomeSummary& s = summary[k];
    const short code = static_cast<short>(s.code);
    const char *name = s.name.c_str(), *alias = s.alias.c_str();
    const unsigned long long count = s.share.count;
    f.write(state_->kind_code, {k}, {1}, &code);
    f.write(state_->kind_name, {k}, {1}, &name);
    f.write(state_->kind_alias, {k}, {1}, &alias);
    f.write(state_->kind_count, {k}, {1}, &count);
    f.write(state_->kind_share, {k}, {1}, &s.share.share);
    f.write(state_->kind_low, {k}, {1}, &s.share.low);
    f.write(state_->kind_high, {k}, {1}, &s.share.high);
    if (state_->method == SamplingMethod::random) continue;
    const char* interval = interval_names[static_cast<std::size_t>(s.share.by)];
    f.write(state_->kind_interval, {k}, {1}, &interval);
    f.write(state_->kind_effective, {k}, {1}, &s.share.effective_starts);
  }
  if (state_->method == SamplingMethod::sobol)
    f.attribute(NC_GLOBAL, "sampling_points_per_replicate", fmt::format("{}", state_->stored / sobol_replicates));
  f.attribute(NC_GLOBAL, "study", resolved_study);
  f.attribute(NC_GLOBAL, "complete", complete ? "yes" : "no");
  const RunTime before = this->time();
  f.attribute(NC_GLOBAL, "seconds", fmt::format("{:.3f}", before.seconds + time.seconds));
  f.attribute(NC_GLOBAL, "cpu_seconds", fmt::format("{:.3f}", before.cpu_seconds + time.cpu_seconds));
  f.sync();
}

}  // namespace equipoise
