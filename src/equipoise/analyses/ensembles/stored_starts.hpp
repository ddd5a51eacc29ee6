// An ensemble's starts in its output file: read and checked before a run resumes, appended as they are decided.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "equipoise/analyses/ensembles/chunks.hpp"
#include "equipoise/results/result_files/basin_file.hpp"
#include "equipoise/study/contents/study.hpp"
#include "equipoise/study/sampling/sampling.hpp"

namespace equipoise {

/// Calls visit(outcome, row) for starts begin .. end - 1 of a file; `row` is null if it holds no transients.
template <class Visit>
void for_each_stored(const BasinFile& file, std::uint64_t begin, std::uint64_t end, const Visit& visit) {
  constexpr std::size_t block = 65536;
  for (std::uint64_t first = begin; first < end; first += block) {
    const std::size_t count = std::min<std::uint64_t>(block, end - first);
    const StartArrays starts = file.read(first, count);
    for (std::size_t i = 0; i < count; ++i) {
      const TransientRow row = row_of(starts, i);
      visit(*outcome_of(starts, i), starts.transients.front().empty() ? nullptr : &row);
    }
  }
}

/// Decides a few of the first `stored` starts again before any is added. A different build or instruction set may give
/// other bits, and the file would then mix two kinds. Throws InputError if an Outcome differs. `decide` decides and
/// settles a chunk, and returns false if stopped.
void check_stored(const BasinFile& file, const std::string& path, std::uint64_t stored, const std::string& target,
                  const std::function<bool(Chunk&)>& decide);

/// Appends the chunk's starts at places part.first .. part.second - 1. `start_of`: a start's initial values by its
/// index. `own`: the caller gave them.
void append_starts(BasinFile& file, const Study& study, const Sampler& sampler, const Chunk& chunk,
                   std::pair<std::size_t, std::size_t> part, bool own,
                   const std::function<InitialState(std::uint64_t)>& start_of, const RunTime& so_far);

}  // namespace equipoise
