// Probes pixels at even distances along each line, many lines at a time.
#include "equipoise/analyses/basin_slices/line_motions.hpp"

#include <algorithm>

#include "equipoise/attractors/motions/motion_bytes.hpp"
#include "equipoise/core/running/parallel.hpp"
#include "equipoise/core/running/stage_progress.hpp"

namespace equipoise {

template <class Bytes, Like<KnownFeatures> T>
void members(Bytes& b, T& k) {
  b(k.features, k.attractor, k.chaotic, k.chaos, k.trend);
}

template <class Bytes, Like<MetMotions> T>
void members(Bytes& b, T& m) {
  b(m.known, m.motions, m.follows_open);
}

namespace {

// This many lines keep the lanes full while the slowest pixels are followed to the end.
constexpr std::size_t lines_together = 16;
constexpr std::size_t fewest_probes = 4, most_probes = 16;

// At most one pixel in eight is decided twice.
std::size_t probes_of(std::size_t length) { return std::min(most_probes, length / 8); }

}  // namespace

bool LineMotions::pays(int pixels) { return probes_of(static_cast<std::size_t>(pixels)) >= fewest_probes; }

LineMotions::LineMotions(const BasinSlice& map, bool columns, const Session& session, SearchLog* notes)
    : map_(map),
      columns_(columns),
      session_(session),
      lines_(static_cast<std::size_t>(columns ? map.x.pixels : map.y.pixels)),
      length_(static_cast<std::size_t>(columns ? map.y.pixels : map.x.pixels)),
      probes_(probes_of(length_)),
      page_(notes, "motions along the lines of a map"),
      groups_((lines_ + lines_together - 1) / lines_together) {
  first_note_ = page_.reserve(groups_.size());
}

std::size_t LineMotions::line_of(std::uint32_t position) const {
  const std::size_t across = static_cast<std::size_t>(map_.x.pixels);
  return columns_ ? position % across : position / across;
}

std::uint32_t LineMotions::pixel(std::size_t line, std::size_t along) const {
  const std::size_t across = static_cast<std::size_t>(map_.x.pixels);
  return static_cast<std::uint32_t>(columns_ ? along * across + line : line * across + along);
}

bool LineMotions::look_along(const std::vector<std::uint32_t>& positions, const StartAt& start,
                             const RunOptions& options) {
  std::vector<bool> asked(groups_.size(), false);
  for (const std::uint32_t position : positions) asked[line_of(position) / lines_together] = true;
  std::vector<std::size_t> open;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    if (asked[g] && groups_[g].empty()) open.push_back(g);
  if (open.empty()) return true;
  StageProgress progress("looking for attractors", options.progress);
  progress.begin("motions along the lines of the map", open.size());
  in_parallel(map_.threads, open.size(), [&](std::size_t k) {
    if (is_set(options.stop)) return;
    groups_[open[k]] = page_.answer_at(
        first_note_ + open[k], "motions", options.stop, [&] { return look(open[k], start); },
        [&](std::vector<MetMotions>& met) { return fits(open[k], start, met); });
    progress.add(1);
  });
  if (is_set(options.stop)) return false;
  page_.finish();
  return true;
}

// What was read, which may be anything.
bool LineMotions::fits(std::size_t group, const StartAt& start, std::vector<MetMotions>& met) const {
  const std::size_t first = group * lines_together, count = std::min(lines_together, lines_ - first);
  if (met.size() != count) return false;
  for (std::size_t line = 0; line < count; ++line) {
    const model::System system = start(pixel(first + line, 0)).own.study.system();
    const int motions = static_cast<int>(met[line].motions.size());
    for (Motion& motion : met[line].motions)
      if (!fits_system(system, motion)) return false;
    for (const KnownFeatures& k : met[line].known)
      if (k.attractor < -motions || k.attractor > -1 || k.chaos != -1 || k.trend != -1) return false;
  }
  return true;
}

// Empty if stopped.
std::vector<MetMotions> LineMotions::look(std::size_t group, const StartAt& start) const {
  const std::size_t first = group * lines_together, count = std::min(lines_together, lines_ - first);
  const MetMotions none;
  std::vector<FamilyStart> starts;
  std::vector<std::size_t> rotor;
  for (std::size_t line = 0; line < count; ++line) {
    for (std::size_t k = 0; k < probes_; ++k) {
      starts.push_back(start(pixel(first + line, (2 * k + 1) * length_ / (2 * probes_))));
      starts.back().met = &none;
      rotor.push_back(line);
    }
  }
  std::vector<MetMotions> met(count);
  if (!session_.meet(std::move(starts), rotor, met)) met.clear();
  return met;
}

const MetMotions& LineMotions::at(std::uint32_t position) const {
  const std::size_t line = line_of(position);
  return groups_[line / lines_together][line % lines_together];
}

}  // namespace equipoise
