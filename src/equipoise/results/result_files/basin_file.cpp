// Basin results: finished ones in NetCDF, new ones in a journal, read as one.
#include "equipoise/results/result_files/basin_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <netcdf.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/io/dataset_file.hpp"
#include "equipoise/results/io/journal.hpp"
#include "equipoise/results/io/kept_search_log.hpp"
#include "equipoise/results/io/sealed_file.hpp"
#include "equipoise/results/result_files/basin_netcdf.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/result_identity.hpp"
#include "equipoise/results/result_files/share_columns.hpp"
#include "equipoise/results/result_files/start_columns.hpp"
#include "equipoise/results/words/files.hpp"

namespace equipoise {

namespace {
constexpr std::uint64_t most_starts = 1'000'000'000'000;
}  // namespace

struct BasinFile::State {
  // Starts first .. first + count - 1, found in a record of the journal.
  struct Piece {
    std::uint64_t first = 0, count = 0;
    io::Journal::Record record;
  };

  std::string path;
  BasinFileHeader header;
  std::vector<io::StartColumn> columns;
  std::size_t start_bytes = 0;  // of all columns
  std::uint64_t stored = 0, finished = 0;
  std::vector<Piece> pieces;
  std::map<std::uint64_t, io::Journal::Record> later;  // by first start: those behind a gap
  std::vector<std::vector<double>> discoveries;
  std::vector<std::string> cpu_targets;
  RunTime time;
  std::optional<io::NetcdfFile> file;
  std::vector<int> variables;  // of the columns, in `file`
  std::optional<io::Journal> journal;
  std::unique_ptr<SearchLog> notes;

  std::size_t state_size() const { return header.drawn.empty() ? header.variables.size() : 1; }
  std::size_t column(std::string_view name) const;
  void require_same(const std::string& there, const std::string& identity) const;
  void open_results();
  void read_results();
  void read_journal();
  void take(const io::Journal::Record& record);
  void use_records();
  void note_target(const std::string& target);
  void append(io::Journal::Record record, const void* payload, std::size_t bytes);
  void read(std::size_t column, std::uint64_t first, std::size_t count, void* values) const;
  template <class T>
  std::vector<T> values(const char* column, std::uint64_t first, std::size_t count) const {
    std::vector<T> result(count);
    read(this->column(column), first, count, result.data());
    return result;
  }
  void read_share(std::size_t kind, Share& share) const;
};

std::size_t BasinFile::State::column(std::string_view name) const {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
  if (found == columns.end()) throw RunError(fmt::format("{}: holds no {}", path, name));
  return static_cast<std::size_t>(found - columns.begin());
}

void BasinFile::State::require_same(const std::string& there, const std::string& of) const {
  io::require_same(there, io::identity_of(header), of, words::files::results_of_this_study,
                   words::files::same_study_or_new);
}

void BasinFile::State::open_results() {
  if (!std::filesystem::exists(path)) return;
  if (const std::string damage = io::why_not_whole(path); !damage.empty())
    throw InputError(path, "", "", fmt::format("{}; {}", damage, words::files::same_study_or_new));
  try {
    file.emplace(path, io::NetcdfFile::Mode::read);
    require_same(file->attribute("identity"), path);
    read_results();
  } catch (const RunError& e) {
    throw InputError("output", "", "", fmt::format("{} ({})", e.what(), words::files::same_study_or_new));
  }
}

void BasinFile::State::read_results() {
  stored = finished = file->length("start");
  for (const io::StartColumn& c : columns) {
    std::vector<std::size_t> shape{finished};
    if (!c.along.empty()) shape.push_back(c.width);
    variables.push_back(file->variable(c.name, io::netcdf_type(c.type), shape));
  }
  discoveries.assign(file->length("discovery"), std::vector<double>(state_size()));
  if (!discoveries.empty()) {
    const int states = file->variable("discovery_state", NC_DOUBLE, {discoveries.size(), state_size()});
    for (std::size_t k = 0; k < discoveries.size(); ++k)
      file->read(states, {k, 0}, {1, state_size()}, discoveries[k].data());
  }
  time = {number_in(file->attribute("seconds")), number_in(file->attribute("cpu_seconds"))};
  const std::string targets = file->attribute("cpu_target");
  for (std::size_t at = 0; at < targets.size();) {
    const std::size_t end = std::min(targets.find(", ", at), targets.size());
    cpu_targets.push_back(targets.substr(at, end - at));
    at = end + 2;
  }
}

void BasinFile::State::read_journal() {
  require_same(journal->identity(), path + ".part");
  for (const io::Journal::Record& record : journal->records()) take(record);
  use_records();
}

// A run killed between writing its results and removing its journal leaves both. Records in the results are skipped.
void BasinFile::State::take(const io::Journal::Record& record) {
  using Kind = io::Journal::Kind;
  if (record.kind == Kind::note) return;
  if (record.kind == Kind::cpu_target && record.bytes < 100) {
    std::string target(record.bytes, '\0');
    journal->read(record, 0, record.bytes, target.data());
    return note_target(target);
  }
  const bool states = record.kind == Kind::discovery;
  const std::size_t each = states ? state_size() * sizeof(double) : start_bytes;
  const bool fits = (states || record.kind == Kind::starts) && record.count > 0 && record.count <= record.bytes &&
                    record.bytes == record.count * each && record.first <= most_starts &&
                    (!states || record.count == 1);
  if (!fits) throw InputError(path + ".part", "", "", fmt::format(words::files::does_not_follow, path));
  time = {std::max(time.seconds, record.seconds), std::max(time.cpu_seconds, record.cpu_seconds)};
  if (states) {
    std::vector<double> state(state_size());
    journal->read(record, 0, record.bytes, state.data());
    if (std::find(discoveries.begin(), discoveries.end(), state) == discoveries.end()) discoveries.push_back(state);
    return;
  }
  io::Journal::Record& there = later[record.first];
  if (record.count > there.count) there = record;
}

void BasinFile::State::use_records() {
  while (!later.empty() && later.begin()->first <= stored) {
    const io::Journal::Record record = later.begin()->second;
    later.erase(later.begin());
    const std::uint64_t end = record.first + record.count;
    if (end <= stored) continue;
    pieces.push_back({stored, end - stored, record});
    stored = end;
  }
}

void BasinFile::State::note_target(const std::string& target) {
  if (std::find(cpu_targets.begin(), cpu_targets.end(), target) == cpu_targets.end()) cpu_targets.push_back(target);
}

void BasinFile::State::read(std::size_t k, std::uint64_t first, std::size_t count, void* values) const {
  char* to = static_cast<char*>(values);
  const std::size_t each = columns[k].bytes();
  if (first < finished) {
    const std::size_t part = std::min<std::uint64_t>(count, finished - first);
    std::vector<std::size_t> begin{first}, length{part};
    if (!columns[k].along.empty()) begin.push_back(0), length.push_back(columns[k].width);
    file->read(variables[k], begin, length, to);
    to += part * each;
    first += part;
    count -= part;
  }
  std::size_t before = 0;  // bytes per start in the columns before this one
  for (std::size_t j = 0; j < k; ++j) before += columns[j].bytes();
  auto piece = std::upper_bound(pieces.begin(), pieces.end(), first,
                                [](std::uint64_t value, const Piece& p) { return value < p.first + p.count; });
  for (; count > 0; ++piece) {
    if (piece == pieces.end()) throw RunError(fmt::format(words::files::start_is_missing, path, first));
    const std::size_t part = std::min<std::uint64_t>(count, piece->first + piece->count - first);
    const std::uint64_t offset = before * piece->record.count + (first - piece->record.first) * each;
    journal->read(piece->record, offset, part * each, to);
    to += part * each;
    first += part;
    count -= part;
  }
}

BasinFile::BasinFile(const std::string& path, const BasinFileHeader& header) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.path = io::results_path(path, words::files::same_study_or_new);
  s.header = header;
  s.columns = io::start_columns(header);
  for (const io::StartColumn& c : s.columns) s.start_bytes += c.bytes();
  s.journal.emplace(s.path + ".part", s.path, io::identity_of(header));
  s.open_results();
  s.read_journal();
  s.notes = io::notes_kept_in(*s.journal);
}

SearchLog& BasinFile::notes() { return *state_->notes; }

void BasinFile::forget_notes() {
  if (state_->later.empty()) state_->journal->remove();
}

BasinFile::~BasinFile() = default;

std::uint64_t BasinFile::stored() const { return state_->stored; }

std::uint64_t BasinFile::stored_next() const {
  constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
  return state_->later.empty() ? none : state_->later.begin()->first;
}

std::string BasinFile::loss() const {
  std::string bytes = state_->journal->loss();
  std::uint64_t lost = 0, known = state_->stored;
  for (const auto& [first, record] : state_->later) {
    lost += first - std::min(first, known);
    known = std::max(known, first + record.count);
  }
  if (lost == 0) return bytes;
  return fmt::format(words::files::lost_starts, bytes.empty() ? state_->path + ".part:" : bytes + ";", lost,
                     state_->stored);
}

std::uint64_t BasinFile::unfinished() const { return state_->stored - state_->finished; }

std::vector<Fate> BasinFile::read(std::uint64_t first, std::size_t count) const {
  const auto codes = state_->values<short>("outcome", first, count);
  const auto times = state_->values<double>("decision_time", first, count);
  const auto grounds = state_->values<signed char>("decided_by", first, count);
  std::vector<Fate> fates(count);
  for (std::size_t i = 0; i < count; ++i)
    if (!io::fate_from(codes[i], grounds[i], times[i], fates[i]))
      throw RunError(fmt::format(words::files::start_without_outcome, state_->path, first + i));
  if (state_->header.driven) {
    const auto speeds = state_->values<float>("mean_speed", first, count);
    for (std::size_t i = 0; i < count; ++i)
      if (speeds[i] != io::missing_figure) fates[i].mean_speed = speeds[i];
  }
  if (state_->header.sticks) {
    const auto left = state_->values<float>("left_unbalance", first, count);
    for (std::size_t i = 0; i < count; ++i)
      if (left[i] != io::missing_figure) fates[i].unbalance = left[i];
  }
  if (state_->header.touches) {
    const auto met = state_->values<signed char>("balls_met", first, count);
    for (std::size_t i = 0; i < count; ++i) fates[i].met = met[i] != 0;
  }
  return fates;
}

// A figure is missing in the file if it has no value: all of a start that was lost, the settling time of one that did
// not settle, the time above a limit of one that stays above it.
std::vector<TransientRow> BasinFile::read_transients(std::uint64_t first, std::size_t count) const {
  std::vector<TransientRow> rows(count);
  std::vector<bool> lost;
  for (const TransientFigure& f : transient_figures) {
    const auto values = state_->values<float>(f.name, first, count);
    if (lost.empty())
      for (const float peak : values) lost.push_back(peak == io::missing_figure);
    for (std::size_t i = 0; i < count; ++i)
      rows[i].*f.value = values[i] != io::missing_figure ? values[i]
                         : lost[i] || !f.needs           ? std::numeric_limits<float>::quiet_NaN()
                                                         : std::numeric_limits<float>::infinity();
  }
  return rows;
}

void BasinFile::State::append(io::Journal::Record record, const void* payload, std::size_t bytes) {
  try {
    journal->append(record, payload, bytes);
  } catch (const RunError& e) {
    throw RunError(fmt::format(words::files::starts_are_kept, e.what(), stored));
  }
}

void BasinFile::append(const StartBatch& batch, const RunTime& so_far) {
  if (batch.count == 0) return;
  State& s = *state_;
  const std::string& target = s.header.cpu_target;
  if (std::find(s.cpu_targets.begin(), s.cpu_targets.end(), target) == s.cpu_targets.end()) {
    s.append({.kind = io::Journal::Kind::cpu_target}, target.data(), target.size());
    s.note_target(target);
  }
  const std::vector<char> payload = io::pack(s.columns, batch);
  s.append({.first = s.stored,
            .count = batch.count,
            .seconds = s.time.seconds + so_far.seconds,
            .cpu_seconds = s.time.cpu_seconds + so_far.cpu_seconds},
           payload.data(), payload.size());
  s.pieces.push_back({s.stored, batch.count, s.journal->records().back()});
  s.stored += batch.count;
  s.use_records();
}

const std::vector<std::string>& BasinFile::cpu_targets() const { return state_->cpu_targets; }

std::vector<std::vector<double>> BasinFile::discoveries() const { return state_->discoveries; }

void BasinFile::append_attractor_search(const std::vector<double>& state) {
  state_->append({.kind = io::Journal::Kind::discovery, .first = state_->discoveries.size(), .count = 1}, state.data(),
                 state.size() * sizeof(double));
  state_->discoveries.push_back(state);
}

bool BasinFile::complete() const {
  return state_->file && unfinished() == 0 && state_->file->attribute("complete") == "yes";
}

// Everything about a share except its count.
void BasinFile::State::read_share(std::size_t k, Share& share) const {
  const std::size_t kinds = file->length("outcome_kind");
  const auto get = [&](const std::string& name, double& value) {
    file->read(file->variable("kind_" + name, NC_DOUBLE, {kinds}), {k}, {1}, &value);
  };
  for (const io::ShareColumn& c : io::share_columns) get(c.name, share.*c.value);
  get("effective_starts", share.effective_starts);
  const std::string by = file->read_text("kind_interval", k);
  const auto found = std::find(interval_names.begin(), interval_names.end(), by);
  if (found == interval_names.end()) throw RunError(fmt::format("{}: kind_interval {} is none", path, by));
  share.by = static_cast<IntervalBy>(found - interval_names.begin());
  share.standard_error =
      share.effective_starts > 0.0 ? std::sqrt(share.share * (1.0 - share.share) / share.effective_starts) : 0.0;
}

std::vector<OutcomeShare> BasinFile::summary() const {
  if (!state_->file) return {};
  const io::NetcdfFile& f = *state_->file;
  std::vector<OutcomeShare> lines = io::read_outcome_kinds(f, "kind_");
  const bool few = state_->finished <= static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  const int counts = f.variable("kind_count", few ? NC_INT : NC_DOUBLE, {lines.size()});
  for (std::size_t k = 0; k < lines.size(); ++k) {
    OutcomeShare& s = lines[k];
    int small = 0;
    double large = 0.0;
    f.read(counts, {k}, {1}, few ? static_cast<void*>(&small) : &large);
    s.share =
        wilson_share(few ? static_cast<std::uint64_t>(small) : static_cast<std::uint64_t>(large), state_->finished);
    if (state_->header.method != SamplingMethod::random) state_->read_share(k, s.share);
  }
  return lines;
}

RunTime BasinFile::time() const { return state_->time; }

void BasinFile::finish(const std::string& resolved_study, const std::vector<OutcomeShare>& summary, bool complete,
                       const RunTime& time, const std::optional<TransientGroup>& all,
                       const std::optional<WithoutBalls>& without_balls) {
  State& s = *state_;
  if (s.stored == 0) return;
  io::BasinContents contents{s.header,      s.columns, s.stored,       {},       s.discoveries,
                             s.cpu_targets, summary,   resolved_study, complete, {}};
  contents.read = [&s](std::size_t column, std::uint64_t first, std::size_t count, void* values) {
    s.read(column, first, count, values);
  };
  contents.all = all;
  contents.without_balls = without_balls;
  contents.time = {s.time.seconds + time.seconds, s.time.cpu_seconds + time.cpu_seconds};
  try {
    s.journal->require_sound();
    io::write_basin_netcdf(s.path, contents);
  } catch (const RunError& e) {
    throw RunError(fmt::format(words::files::starts_are_kept_in_part, e.what(), s.stored, s.path));
  }
  if (s.later.empty()) io::leave_notes(*s.journal, complete);
}

}  // namespace equipoise
