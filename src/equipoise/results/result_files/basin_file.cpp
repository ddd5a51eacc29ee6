// An ensemble as a store of starts.
#include "equipoise/results/result_files/basin_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include <fmt/format.h>

#include "equipoise/core/base/error.hpp"
#include "equipoise/core/base/read_number.hpp"
#include "equipoise/results/result_files/basin_outcomes.hpp"
#include "equipoise/results/result_files/result_identity.hpp"

namespace equipoise {

namespace {

constexpr std::uint64_t most_starts = 1'000'000'000'000;

io::RowStore::Layout layout_of(const BasinFileHeader& header, const std::vector<io::StartColumn>& columns) {
  return {.rows = io::Journal::Kind::starts,
          .text = io::Journal::Kind::cpu_target,
          .most = most_starts,
          .lines = "start",
          .columns = {columns.begin(), columns.end()},
          .components = header.drawn.empty() ? header.variables.size() : 1};
}

// The first of the starts that has none.
std::optional<std::size_t> without_outcome(const StartArrays& starts) {
  for (std::size_t i = 0; i < starts.starts; ++i)
    if (!outcome_of(starts, i)) return i;
  return {};
}

}  // namespace

BasinFile::BasinFile(const std::string& path, const BasinFileHeader& header)
    : RowStore(path, io::identity_of(header),
               {"results of this study", "must be a new file, or results of the same study"},
               layout_of(header, io::start_columns(header))),
      header_(header),
      columns_(io::start_columns(header)),
      stored_(finished()) {
  reading([this] {
    if (!results()) return;
    time_ = {number_in(results()->attribute("seconds")), number_in(results()->attribute("cpu_seconds"))};
    std::istringstream targets(results()->attribute("cpu_target"));
    for (std::string target; std::getline(targets >> std::ws, target, ',');) cpu_targets_.push_back(target);
  });
  for (const auto& [number, target] : texts())
    if (!ran_on(target)) cpu_targets_.push_back(target);
  for (const io::Journal::Record& record : new_rows()) {
    StartArrays starts;
    starts.starts = record.count;
    for (std::size_t k = 0; k < columns_.size(); ++k) columns_[k].take(values_in(record, k), starts);
    if (const auto lost = without_outcome(starts))
      refuse(part(), fmt::format("is damaged: start {} has no valid outcome", record.first + *lost));
    hold(record.first, record.count);
    time_ = {std::max(time_.seconds, record.seconds), std::max(time_.cpu_seconds, record.cpu_seconds)};
  }
}

void BasinFile::hold(std::uint64_t first, std::uint64_t count) {
  std::uint64_t& end = behind_[first];
  end = std::max(end, first + count);
  for (auto next = behind_.begin(); next != behind_.end() && next->first <= stored_; next = behind_.erase(next))
    stored_ = std::max(stored_, next->second);
}

bool BasinFile::ran_on(const std::string& target) const {
  return std::find(cpu_targets_.begin(), cpu_targets_.end(), target) != cpu_targets_.end();
}

void BasinFile::forget_notes() {
  if (behind_.empty()) forget();
}

void BasinFile::append(const StartArrays& starts, const RunTime& so_far) {
  if (starts.starts == 0) return;
  if (!ran_on(header_.cpu_target)) {
    append_text(0, header_.cpu_target);
    cpu_targets_.push_back(header_.cpu_target);
  }
  append_rows({.first = stored_,
               .count = starts.starts,
               .seconds = time_.seconds + so_far.seconds,
               .cpu_seconds = time_.cpu_seconds + so_far.cpu_seconds},
              [&](std::size_t column, std::size_t place) { return columns_[column].stored(starts, place); });
  hold(stored_, starts.starts);
}

std::string BasinFile::loss() const {
  const std::string bytes = RowStore::loss();
  std::uint64_t lost = 0, known = stored_;
  for (const auto& [first, end] : behind_) {
    lost += first - std::min(first, known);
    known = std::max(known, end);
  }
  if (lost == 0) return bytes;
  return fmt::format("{} {} starts are missing, from number {} on", bytes.empty() ? part() + ":" : bytes + ";", lost,
                     stored_);
}

std::vector<OutcomeShare> BasinFile::summary() const {
  if (!results()) return {};
  using Type = DataColumn::Type;
  const io::NetcdfFile& file = *results();
  std::vector<OutcomeShare> lines = io::read_outcome_kinds(file, "kind_");
  const auto get = [&](const std::string& name, Type type) {
    return io::read_column(file, "kind_" + name, type, {lines.size()});
  };
  const bool few = finished() <= static_cast<std::uint64_t>(std::numeric_limits<int>::max());
  const std::vector<double> counts = get("count", few ? Type::integer : Type::real);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const double count = std::clamp(counts[k], 0.0, static_cast<double>(finished()));
    lines[k].share = wilson_share(static_cast<std::uint64_t>(count), finished());
  }
  if (header_.method == SamplingMethod::random) return lines;
  for (const ShareColumn& c : share_columns) {
    const std::vector<double> values = io::read_shares(file, std::string("kind_") + c.name);
    for (std::size_t k = 0; k < lines.size(); ++k) lines[k].share.*c.value = values[k];
  }
  const std::vector<double> effective = get("effective_starts", Type::real);
  for (std::size_t k = 0; k < lines.size(); ++k) {
    Share& s = lines[k].share;
    const std::string by = file.read_text("kind_interval", k);
    const auto found = std::find(interval_names.begin(), interval_names.end(), by);
    if (found == interval_names.end()) throw RunError(fmt::format("{}: kind_interval {} is none", path(), by));
    s.by = static_cast<IntervalBy>(found - interval_names.begin());
    s.effective_starts = effective[k];
    s.standard_error = s.effective_starts > 0.0 ? std::sqrt(s.share * (1.0 - s.share) / s.effective_starts) : 0.0;
  }
  return lines;
}

StartArrays BasinFile::read(std::uint64_t first, std::size_t count) const {
  if (first + count > stored_) throw RunError(fmt::format("{}: start {} is not there", path(), stored_));
  StartArrays starts;
  starts.starts = count;
  starts.balls = header_.balls;
  std::vector<double> values;
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    values.resize(count * columns_[k].width);
    RowStore::read(k, first, count, values.data());
    columns_[k].take(values, starts);
  }
  if (const auto lost = without_outcome(starts))
    throw RunError(fmt::format("{}: start {} has no valid outcome; the file is damaged", path(), first + *lost));
  return starts;
}

void BasinFile::finish(const BasinEnd& end) {
  if (stored_ == 0) return;
  const auto values = [this](std::size_t k) -> DataValues {
    return [this, k, width = columns_[k].width](std::size_t first, std::size_t count, double* to) {
      RowStore::read(k, first / width, count / width, to);
    };
  };
  io::BasinContents contents{end, header_, stored_, values, discoveries(), cpu_targets_};
  contents.time = {time_.seconds + end.time.seconds, time_.cpu_seconds + end.time.cpu_seconds};
  const Rest rest = behind_.empty() && end.complete ? Rest::nothing : behind_.empty() ? Rest::notes : Rest::all;
  Store::finish([&](const std::string& place) { io::write_netcdf_file(place, io::basin_dataset(contents)); }, rest);
}

}  // namespace equipoise
