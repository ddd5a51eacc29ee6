// Basin results in NetCDF-4: created once, appended in index order, resumed.
#include "equipoise/store/basin_file.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <netcdf.h>

#include "equipoise/base/error.hpp"
#include "equipoise/base/version.hpp"
#include "equipoise/store/netcdf.hpp"

namespace equipoise {

namespace {
constexpr std::size_t chunk_length = 8192;

// What a file must share with a run for the run to add to it.
std::string identity(const BasinFileHeader& header) {
  return fmt::format("{}\n# seed {}\n# cpu target {}\n# version {}\n", header.study, header.seed, header.cpu_target,
                     version_string);
}
}  // namespace

struct BasinFile::State {
  std::string path;
  std::optional<store::NetcdfFile> file;
  std::size_t balls = 2, stored = 0;
  int phi = -1, outcome = -1, time = -1, kind_count = -1, kind_share = -1, kind_low = -1, kind_high = -1;

  void create(const BasinFileHeader& header);
  void open(const BasinFileHeader& header);
  void find_variables();
};

void BasinFile::State::create(const BasinFileHeader& header) {
  file.emplace(path, store::NetcdfFile::Mode::create);
  store::NetcdfFile& f = *file;
  const int start = f.dimension("start", store::NetcdfFile::unlimited);
  const int ball = f.dimension("ball", balls);
  const int kind = f.dimension("outcome_kind", outcome_count);
  phi = f.variable("phi", NC_DOUBLE, {start, ball}, "radian",
                   "initial ball angle from the direction of the centre of mass, rotating frame");
  outcome = f.variable("outcome", NC_BYTE, {start}, "1", "what became of the start");
  time =
      f.variable("decision_time", NC_DOUBLE, {start}, "1", "study time at which the outcome was known, in 1/omega_c");
  f.chunk(phi, {chunk_length, balls});
  f.chunk(outcome, {chunk_length});
  f.chunk(time, {chunk_length});
  std::vector<signed char> values;
  std::string meanings;
  for (int k = 0; k < outcome_count; ++k) {
    values.push_back(static_cast<signed char>(k));
    std::string name = outcome_names[k];
    std::replace(name.begin(), name.end(), ' ', '_');
    meanings += (k ? " " : "") + name;
  }
  f.attribute(outcome, "flag_values", values);
  f.attribute(outcome, "flag_meanings", meanings);
  const int kind_name = f.variable("kind_name", NC_STRING, {kind}, "1", "name of the outcome");
  kind_count = f.variable("kind_count", NC_UINT64, {kind}, "1", "starts with the outcome");
  kind_share = f.variable("kind_share", NC_DOUBLE, {kind}, "1", "share of the starts with the outcome");
  kind_low = f.variable("kind_share_low", NC_DOUBLE, {kind}, "1", "lower end of the 95 % Wilson interval of the share");
  kind_high =
      f.variable("kind_share_high", NC_DOUBLE, {kind}, "1", "upper end of the 95 % Wilson interval of the share");
  f.attribute(NC_GLOBAL, "Conventions", "CF-1.8");
  f.attribute(NC_GLOBAL, "title", "Basins of a rotor with an automatic ball balancer");
  f.attribute(NC_GLOBAL, "source", fmt::format("equipoise {}", version_string));
  f.attribute(NC_GLOBAL, "identity", identity(header));
  f.attribute(NC_GLOBAL, "cpu_target", header.cpu_target);
  f.attribute(NC_GLOBAL, "study", header.study);
  f.attribute(NC_GLOBAL, "complete", "no");
  f.end_definitions();
  std::array<const char*, outcome_count> names = outcome_names;
  f.write(kind_name, {0}, {outcome_count}, names.data());
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
}

void BasinFile::State::find_variables() {
  phi = file->variable("phi");
  outcome = file->variable("outcome");
  time = file->variable("decision_time");
  kind_count = file->variable("kind_count");
  kind_share = file->variable("kind_share");
  kind_low = file->variable("kind_share_low");
  kind_high = file->variable("kind_share_high");
}

BasinFile::BasinFile(const std::string& path, const BasinFileHeader& header) : state_(std::make_unique<State>()) {
  state_->path = path;
  state_->balls = static_cast<std::size_t>(header.balls);
  if (std::filesystem::exists(path)) {
    state_->open(header);
    state_->find_variables();
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
  std::vector<signed char> outcomes(count);
  std::vector<double> times(count);
  state_->file->read(state_->outcome, {first}, {count}, outcomes.data());
  state_->file->read(state_->time, {first}, {count}, times.data());
  std::vector<Fate> fates(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (outcomes[i] < 0 || outcomes[i] >= outcome_count)
      throw RunError(fmt::format("{}: start {} has no valid outcome; the file is damaged", state_->path, first + i));
    fates[i] = {static_cast<Outcome>(outcomes[i]), times[i]};
  }
  return fates;
}

void BasinFile::append(std::size_t count, const double* phi, const Fate* fates) {
  if (count == 0) return;
  std::vector<signed char> outcomes(count);
  std::vector<double> times(count);
  for (std::size_t i = 0; i < count; ++i) {
    outcomes[i] = static_cast<signed char>(fates[i].outcome);
    times[i] = fates[i].time;
  }
  const std::size_t at = state_->stored;
  state_->file->write(state_->phi, {at, 0}, {count, state_->balls}, phi);
  state_->file->write(state_->outcome, {at}, {count}, outcomes.data());
  state_->file->write(state_->time, {at}, {count}, times.data());
  state_->stored += count;
}

void BasinFile::sync() { state_->file->sync(); }

void BasinFile::finish(const std::string& resolved_study, const std::array<Share, outcome_count>& shares,
                       bool complete) {
  std::array<unsigned long long, outcome_count> counts{};
  std::array<double, outcome_count> share{}, low{}, high{};
  for (std::size_t k = 0; k < outcome_count; ++k) {
    counts[k] = shares[k].count;
    share[k] = shares[k].share;
    low[k] = shares[k].low;
    high[k] = shares[k].high;
  }
  store::NetcdfFile& f = *state_->file;
  f.write(state_->kind_count, {0}, {outcome_count}, counts.data());
  f.write(state_->kind_share, {0}, {outcome_count}, share.data());
  f.write(state_->kind_low, {0}, {outcome_count}, low.data());
  f.write(state_->kind_high, {0}, {outcome_count}, high.data());
  f.attribute(NC_GLOBAL, "study", resolved_study);
  f.attribute(NC_GLOBAL, "complete", complete ? "yes" : "no");
  f.sync();
}

}  // namespace equipoise
