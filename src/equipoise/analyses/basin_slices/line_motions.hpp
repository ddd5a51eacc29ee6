// Motions that the pixels of a line come to, found before all pixels are decided.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "equipoise/classification/start_runs/session.hpp"
#include "equipoise/core/running/run_options.hpp"
#include "equipoise/core/running/search_log.hpp"
#include "equipoise/results/commands/basin_slice.hpp"

namespace equipoise {

/// If one axis of a slice is a parameter and the other an initial value, all pixels of a line have the same rotor. A
/// few of them find motions that the mesh does not list; the other pixels are then recognised by these, not followed
/// one by one.
class LineMotions {
 public:
  using StartAt = std::function<FamilyStart(std::uint32_t position)>;

  /// Whether lines of this many pixels are long enough.
  static bool pays(int pixels);
  /// `columns`: the lines are columns, else rows, and long enough. `session` must outlive this; `notes` may be null.
  LineMotions(const BasinSlice& map, bool columns, const Session& session, SearchLog* notes);

  /// Probes the lines of these pixels, unless that is done. False if stopped.
  bool look_along(const std::vector<std::uint32_t>& positions, const StartAt& start, const RunOptions& options);
  /// For a line that has been probed.
  const MetMotions& at(std::uint32_t position) const;

 private:
  std::size_t line_of(std::uint32_t position) const;
  std::uint32_t pixel(std::size_t line, std::size_t along) const;
  bool fits(std::size_t group, const StartAt& start, std::vector<MetMotions>& met) const;
  std::vector<MetMotions> look(std::size_t group, const StartAt& start) const;

  const BasinSlice& map_;
  const bool columns_;
  const Session& session_;
  const std::size_t lines_, length_, probes_;
  NotePage page_;
  std::uint64_t first_note_;
  std::vector<std::vector<MetMotions>> groups_;  // by groups of lines probed together; empty: not yet
};

}  // namespace equipoise
